#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

#include "core/go_on.h"
#include "core/workers.h"

namespace instep {

/// The same workers as long as `go_on` allows it, which is asked after each job: once it said no,
/// `wanted`, true at first, is false, and jobs that are not begun are not done. Borrows all three.
inline Workers while_wanted(const Workers& workers, const GoOn& go_on, std::atomic<bool>& wanted) {
  return [&](std::size_t count, const std::function<void(std::size_t job)>& work) {
    workers(count, [&](std::size_t job) {
      if (!wanted) return;
      work(job);
      if (!go_on()) wanted = false;
    });
  };
}

}  // namespace instep
