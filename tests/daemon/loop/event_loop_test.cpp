#include "daemon/loop/event_loop.h"

#include <gtest/gtest.h>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include "drivers/files/wake_up.h"

namespace instep {
namespace {

using namespace std::chrono_literals;

class EventLoopTest : public testing::Test {
 protected:
  std::unique_ptr<EventLoop> loop_ = EventLoop::create().value();
};

TEST_F(EventLoopTest, RunsWhatOtherThreadsPostInOrder) {
  std::vector<int> done;
  std::thread other([&done, post = loop_->poster(), this] {
    for (int i = 0; i < 100; ++i) post([&done, i] { done.push_back(i); });
    post([this] { loop_->leave(); });
  });
  ASSERT_TRUE(loop_->run());
  other.join();
  ASSERT_EQ(done.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
}

TEST_F(EventLoopTest, TellsThatADescriptorIsReadyUntilTheWatchEnds) {
  WakeUp bell;
  int rung = 0;
  EventLoop::Watch watch;
  auto watching = loop_->watch(bell.descriptor(), EPOLLIN, [&](std::uint32_t events) {
    EXPECT_EQ(events, static_cast<std::uint32_t>(EPOLLIN));
    if (++rung < 3) return;
    watch = {};
    loop_->poster()([this] { loop_->leave(); });
  });
  ASSERT_TRUE(watching);
  watch = std::move(*watching);
  bell.set();
  ASSERT_TRUE(loop_->run());
  EXPECT_EQ(rung, 3);
}

TEST_F(EventLoopTest, SaysThatItCannotWatchWhatCannotBeWaitedFor) {
  EXPECT_FALSE(loop_->watch(-1, EPOLLIN, [](std::uint32_t) {}));
  char name[] = "/tmp/instep-event-loop-XXXXXX";
  const int file = ::mkstemp(name);
  ASSERT_GE(file, 0);
  const auto watching = loop_->watch(file, EPOLLIN, [](std::uint32_t) {});
  ASSERT_FALSE(watching) << "a regular file is always ready, says epoll, and refuses it";
  EXPECT_EQ(watching.error().code, ErrorCode::kIo);
  ::close(file);
  ::unlink(name);
}

TEST_F(EventLoopTest, RingsTimersInTheOrderOfTheirTimesAndOnceEach) {
  std::vector<int> rung;
  auto last = loop_->timer([&] {
    rung.push_back(2);
    loop_->leave();
  });
  auto first = loop_->timer([&] { rung.push_back(1); });
  auto never = loop_->timer([&] { rung.push_back(0); });
  const auto now = EventLoop::monotonic_now();
  last.set_at(now + 2ms);
  first.set_at(now + 1ms);
  never.set_at(now);
  never.clear();
  ASSERT_TRUE(loop_->run());
  EXPECT_EQ(rung, (std::vector<int>{1, 2}));
}

/// Holds what a task holds, and posts once more when it ends.
TEST_F(EventLoopTest, EndsThoughWhatItDropsPostsAgain) {
  bool ran = false;
  std::shared_ptr<void> held(
      nullptr, [&ran, post = loop_->poster()](void*) { post([&ran] { ran = true; }); });
  loop_->poster()([kept = std::move(held)] {});
  loop_.reset();
  EXPECT_FALSE(ran);
}

// For every number of descriptors that it may still open, down to none.
TEST(EventLoopLimits, FailsToBeMadeRatherThanBeDeafWhenDescriptorsAreLacking) {
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const int next = ::dup(0);
  ::close(next);
  int failed = 0;
  bool made = false;
  for (int more = 0; more < 10 && !made; ++more) {
    const rlimit few{static_cast<rlim_t>(next + more), limit.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &few);
    auto loop = EventLoop::create();
    ::setrlimit(RLIMIT_NOFILE, &limit);
    made = loop.has_value();
    if (!made) {
      EXPECT_EQ(loop.error().code, ErrorCode::kIo);
      ++failed;
      continue;
    }
    // What it was made with is enough: posts and timers come through.
    bool posted = false;
    (*loop)->poster()([&posted] { posted = true; });
    auto timer = (*loop)->timer([&] { (*loop)->leave(); });
    timer.set(1ms);
    ASSERT_TRUE((*loop)->run());
    EXPECT_TRUE(posted);
  }
  EXPECT_TRUE(made);
  EXPECT_GE(failed, 3) << "it wants for a descriptor of its own, of its mail and of its timers";
}

}  // namespace
}  // namespace instep
