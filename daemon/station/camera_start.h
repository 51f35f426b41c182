#pragma once

#include <chrono>

#include "core/go_on.h"
#include "core/result.h"
#include "drivers/depth_camera.h"

namespace instep {

/// Starts a camera that may take longer than one call of start() does: calls again for as long as
/// it goes on by itself (see DepthCamera::start), until `deadline`. Asks `go_on` after each call,
/// and fails with kCancelled once it is denied; else as start() does.
Result<void> start_by(DepthCamera& camera, std::chrono::steady_clock::time_point deadline,
                      const GoOn& go_on);

/// Whether it is worth to wait on and call again.
bool is_on_its_way(const Error& error_of_start);

}  // namespace instep
