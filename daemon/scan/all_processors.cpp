#include "daemon/scan/all_processors.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace instep {

void on_all_processors(std::size_t count, const std::function<void(std::size_t job)>& work) {
  std::atomic<std::size_t> next = 0;
  const auto do_jobs = [&] {
    for (std::size_t job = next++; job < count; job = next++) work(job);
  };
  const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::future<void>> others;
  try {
    for (std::size_t i = 1; i < std::min(processors, count); ++i) {
      others.push_back(std::async(std::launch::async, do_jobs));
    }
  } catch (const std::system_error&) {
    // The station is at its limit of threads: those that there are do the work.
  }
  do_jobs();
  for (auto& one : others) one.get();
}

}  // namespace instep
