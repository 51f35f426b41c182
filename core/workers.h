#pragma once

#include <cstddef>
#include <functional>

namespace instep {

/// Does the jobs 0 to count - 1, each once, and returns when all are done. They are independent of
/// each other, so any order and any threads will do; the outcome is the same.
using Workers =
    std::function<void(std::size_t count, const std::function<void(std::size_t job)>& work)>;

/// All jobs on the calling thread.
inline void one_after_the_other(std::size_t count,
                                const std::function<void(std::size_t job)>& work) {
  for (std::size_t job = 0; job < count; ++job) work(job);
}

}  // namespace instep
