#include "daemon/loop/task_thread.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <future>
#include <memory>

#include "tests/support/held_thread.h"

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

/// The number of its thread.
pid_t thread_of(TaskThread& tasks) {
  const auto number = std::make_shared<std::promise<pid_t>>();
  tasks.post([number](TaskProgress&) { number->set_value(::gettid()); });
  return number->get_future().get();
}

/// A service that had ended well was said to have failed.
TEST(TaskThread, LeavesNothingBehindWhenAnIdleOneHasNoTurnToEnd) {
  TaskThread thread("idle");
  const test::HeldThread held(thread_of(thread));
  EXPECT_TRUE(thread.stop_by(steady_clock::now()));
}

TEST(TaskThread, SaysThatATaskWhichHadNoTurnWasLeftBehind) {
  TaskThread thread("idle");
  const test::HeldThread held(thread_of(thread));
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
