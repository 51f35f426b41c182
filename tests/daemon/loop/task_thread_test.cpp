#include "daemon/loop/task_thread.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>
#include <future>
#include <memory>
#include <thread>

#include "drivers/files/descriptor.h"

namespace instep {
namespace {

using std::chrono::steady_clock;

/// Its task runs until it is released.
struct Hanging {
  std::shared_ptr<std::promise<void>> release = std::make_shared<std::promise<void>>();
  std::shared_ptr<std::promise<void>> begun = std::make_shared<std::promise<void>>();
  std::shared_ptr<std::promise<void>> over = std::make_shared<std::promise<void>>();
  TaskThread thread{"hanging"};

  Hanging() {
    thread.post([until = release->get_future().share(), begun = begun, over = over](TaskProgress&) {
      begun->set_value();
      until.wait();
      over->set_value();
    });
    begun->get_future().wait();
  }
};

/// Keeps a thread from running, as a busy machine may, until it is let go.
class HeldThread {
 public:
  explicit HeldThread(pthread_t thread) {
    struct sigaction holding {};
    holding.sa_handler = [](int) {
      add_to(held_.number());
      take_from(let_go_.number());
      add_to(over_.number());
    };
    ::sigaction(SIGUSR2, &holding, &before_);
    ::pthread_kill(thread, SIGUSR2);
    take_from(held_.number());
  }
  ~HeldThread() {
    add_to(let_go_.number());
    take_from(over_.number());
    ::sigaction(SIGUSR2, &before_, nullptr);
  }
  HeldThread(const HeldThread&) = delete;
  HeldThread& operator=(const HeldThread&) = delete;

 private:
  static void add_to(int counter) {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(counter, &one, sizeof one);
  }
  static void take_from(int counter) {
    std::uint64_t count = 0;
    while (::read(counter, &count, sizeof count) < 0) {
    }
  }

  static inline const Descriptor held_{::eventfd(0, EFD_CLOEXEC)};
  static inline const Descriptor let_go_{::eventfd(0, EFD_CLOEXEC)};
  static inline const Descriptor over_{::eventfd(0, EFD_CLOEXEC)};
  struct sigaction before_ {};
};

void wait_until_idle(const TaskThread& thread) {
  while (thread.is_busy()) std::this_thread::yield();
}

/// A service that had ended well was said to have failed.
TEST(TaskThread, LeavesNothingBehindWhenAnIdleOneHasNoTurnToEnd) {
  TaskThread thread("idle");
  std::promise<pthread_t> self;
  thread.post([&self](TaskProgress&) { self.set_value(::pthread_self()); });
  const auto idle = self.get_future().get();
  wait_until_idle(thread);
  const HeldThread held(idle);
  EXPECT_TRUE(thread.stop_by(steady_clock::now()));
}

TEST(TaskThread, SaysThatATaskWhichHadNoTurnWasLeftBehind) {
  TaskThread thread("idle");
  std::promise<pthread_t> self;
  thread.post([&self](TaskProgress&) { self.set_value(::pthread_self()); });
  const auto idle = self.get_future().get();
  wait_until_idle(thread);
  const HeldThread held(idle);
  thread.post([](TaskProgress&) {});
  EXPECT_FALSE(thread.finish_by(steady_clock::now()));
}

TEST(TaskThread, EndsThoughTheDeadlineIsPastWhenItHasNothingToDo) {
  TaskThread thread("idle");
  std::promise<void> done;
  thread.post([&done](TaskProgress&) { done.set_value(); });
  done.get_future().wait();
  EXPECT_TRUE(thread.stop(std::chrono::seconds(30)));
  EXPECT_TRUE(thread.stop_by(steady_clock::now() - std::chrono::seconds(1))) << "it has ended";
}

TEST(TaskThread, SaysThatATaskHadToBeLeftBehind) {
  Hanging hanging;
  bool dropped_ran = false;
  hanging.thread.post([&dropped_ran](TaskProgress&) { dropped_ran = true; });
  EXPECT_FALSE(hanging.thread.stop_by(steady_clock::now()));
  hanging.release->set_value();
  hanging.over->get_future().wait();
  EXPECT_FALSE(dropped_ran);
}

TEST(TaskThread, WaitsForTheTaskThatRuns) {
  Hanging hanging;
  hanging.release->set_value();
  EXPECT_TRUE(hanging.thread.stop_by(steady_clock::now() + std::chrono::seconds(30)));
}

}  // namespace
}  // namespace instep
