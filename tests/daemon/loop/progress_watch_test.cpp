#include "daemon/loop/progress_watch.h"

#include <gtest/gtest.h>

#include <future>

#include "daemon/loop/task_thread.h"

namespace instep {
namespace {

using namespace std::chrono_literals;

TEST(ProgressWatch, IsContentWithThreadsThatRest) {
  ProgressWatch watch;
  for (int look = 0; look < 3; ++look) {
    watch.note("scan", false, 7);
    EXPECT_TRUE(watch.all_moved());
  }
}

TEST(ProgressWatch, IsContentWithABusyThreadAsLongAsItMoves) {
  ProgressWatch watch;
  for (std::uint64_t step = 0; step < 60; ++step) {
    watch.note("scan", true, step);
    EXPECT_TRUE(watch.all_moved());
  }
}

TEST(ProgressWatch, NamesTheBusyThreadThatStandsStill) {
  ProgressWatch watch;
  for (std::uint64_t look = 0; look < 2; ++look) {
    watch.note("archive", true, look);
    watch.note("scan", true, 7);
  }
  EXPECT_FALSE(watch.all_moved());
  EXPECT_EQ(watch.hung(), "scan");
}

TEST(ProgressWatch, ForgivesAThreadThatMovesAgain) {
  ProgressWatch watch;
  for (const std::uint64_t progress : {7U, 7U, 8U}) watch.note("scan", true, progress);
  EXPECT_TRUE(watch.all_moved());
  EXPECT_EQ(watch.hung(), "");
}

// The log said nothing of its second time.
TEST(ProgressWatch, TellsOnceEachTimeThatAThreadHangs) {
  ProgressWatch watch;
  const auto told = [&](std::uint64_t progress) {
    watch.note("scan", true, progress);
    return watch.newly_hung();
  };
  EXPECT_EQ(told(7), "");
  EXPECT_EQ(told(7), "scan");
  EXPECT_EQ(told(7), "");
  EXPECT_EQ(told(8), "");
  EXPECT_EQ(told(8), "scan");
}

TEST(ProgressWatch, SeesAMeasuringThreadThatHangs) {
  std::promise<void> begun, released;
  TaskThread thread("measuring");
  thread.post([&begun, wait = released.get_future().share()](TaskProgress& progress) {
    progress.step();
    begun.set_value();
    wait.wait();
  });
  begun.get_future().wait();
  ProgressWatch watch;
  const auto look = [&] {
    watch.note("scan", thread.is_busy(), thread.progress());
    return watch.all_moved();
  };
  EXPECT_TRUE(look());
  for (int second = 0; second < 10; ++second) EXPECT_FALSE(look());
  released.set_value();
  ASSERT_TRUE(thread.stop(10s));
  EXPECT_TRUE(look());
}

}  // namespace
}  // namespace instep
