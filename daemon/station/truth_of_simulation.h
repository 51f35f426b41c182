#pragma once

#include <functional>
#include <future>
#include <map>
#include <string>

#include "core/result.h"
#include "daemon/loop/task_thread.h"

namespace instep {

/// Has the truth of a simulated station worked out (Devices::work_out_truth) on a thread of its
/// own: it takes seconds, and the station is ready without it. Empty if it cannot be told: a
/// subject without is measured all the same. Invalid if there is nothing to work out.
std::shared_future<std::map<std::string, double>> truth_of_simulation(
    TaskThread& thread, std::function<Result<std::map<std::string, double>>()> work);

}  // namespace instep
