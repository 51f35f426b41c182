#include "daemon/scan/all_processors.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <vector>

namespace instep {
namespace {

TEST(AllProcessors, DoEachJobOnce) {
  for (const std::size_t count : {0U, 1U, 3U, 1000U}) {
    std::vector<std::atomic<int>> done(count);
    on_all_processors(count, [&](std::size_t job) { ++done[job]; });
    for (const auto& times : done) EXPECT_EQ(times, 1) << count << " jobs";
  }
}

TEST(AllProcessors, MayBeAskedFromWithinAJob) {
  std::atomic<int> done = 0;
  on_all_processors(8, [&](std::size_t) { on_all_processors(8, [&](std::size_t) { ++done; }); });
  EXPECT_EQ(done, 64);
}

TEST(AllProcessors, ThrowWhatAJobThrows) {
  EXPECT_THROW(on_all_processors(100, [](std::size_t) { throw std::bad_alloc(); }), std::bad_alloc);
}

}  // namespace
}  // namespace instep
