#include "core/while_wanted.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <vector>

namespace instep {
namespace {

/// The jobs that were done of five when the `last` one is no longer wanted.
std::vector<std::size_t> done_until(std::size_t last, std::atomic<bool>& wanted) {
  std::vector<std::size_t> done;
  const GoOn go_on = [&] { return done.back() != last; };
  const Workers workers = one_after_the_other;
  while_wanted(workers, go_on, wanted)(5, [&](std::size_t job) { done.push_back(job); });
  return done;
}

TEST(WhileWanted, DoesAllJobsThatAreWanted) {
  std::atomic<bool> wanted = true;
  EXPECT_EQ(done_until(9, wanted), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_TRUE(wanted);
}

TEST(WhileWanted, BeginsNoneAfterTheFirstNo) {
  std::atomic<bool> wanted = true;
  EXPECT_EQ(done_until(2, wanted), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_FALSE(wanted);
}

TEST(WhileWanted, TellsANoAfterTheLastJobToo) {
  std::atomic<bool> wanted = true;
  EXPECT_EQ(done_until(4, wanted).size(), 5U);
  EXPECT_FALSE(wanted);
}

}  // namespace
}  // namespace instep
