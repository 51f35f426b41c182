#include "daemon/station/pedal_watch.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "tests/support/contact_pedal.h"
#include "tests/support/held_thread.h"
#include "tests/support/loop_thread.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using test::Contact;
using test::ContactPedal;

/// The pedal of a contact on a loop, and what was told of it.
class PedalOnLoop : public testing::Test {
 protected:
  ~PedalOnLoop() override {
    contact_->let_go();
    loop_.stop();
  }

  void begin(const PedalWatch::Open& open, std::chrono::milliseconds patience = 1h,
             const PedalSettings& settings = {}) {
    loop_.call([&] {
      watch_.emplace(
          loop_.loop(), settings, open,
          PedalWatch::Listener{[this](PedalSignal signal) { signals_.push_back(signal); },
                               [this](const Error& error) {
                                 lost_.push_back(error);
                                 is_there_ = false;
                               },
                               [this] {
                                 ++returned_;
                                 is_there_ = true;
                               }},
          patience);
    });
  }
  /// Of the contact; opens_ counts.
  PedalWatch::Open opening() {
    return [this, contact = contact_]() -> Result<std::unique_ptr<Pedal>> {
      auto pedal = std::make_unique<ContactPedal>(contact);
      loop_.loop().poster()([this] { ++opens_; });
      return pedal;
    };
  }
  bool is_open() {
    return loop_.wait_until([this] { return is_there_; });
  }
  bool hangs() {
    return loop_.wait_until([this] { return contact_->holds_a_call(); });
  }
  void press() {
    const auto now = EventLoop::monotonic_now();
    contact_->give({{true, now}, {false, now + 100ms}});
  }
  /// Returns once nothing is asked of the pedal any more.
  void press_and_come_to_rest() {
    press();
    ASSERT_TRUE(loop_.wait_until(
        [&] { return !signals_.empty() && signals_.back() == PedalSignal::kReleased; }));
    loop_.call([&] {
      EXPECT_EQ(signals_.front(), PedalSignal::kPressed);
      signals_.clear();
    });
  }

  std::shared_ptr<Contact> contact_ = std::make_shared<Contact>();
  test::LoopThread loop_;
  // The loop's, as the watch.
  std::vector<PedalSignal> signals_;
  std::vector<Error> lost_;
  int returned_ = 0;
  bool is_there_ = false;  ///< as was told last
  int opens_ = 0;
  std::optional<PedalWatch> watch_;
};

TEST_F(PedalOnLoop, TakesNewTimesWhileItIsOpen) {
  PedalSettings settings;
  settings.debounce = 200ms;
  begin(opening(), 1h, settings);
  ASSERT_TRUE(is_open());
  settings.debounce = 30ms;
  loop_.call([&] { watch_->set(settings); });
  const auto now = EventLoop::monotonic_now();
  contact_->give({{true, now}, {false, now + 100ms}});  // too short for the old time
  ASSERT_TRUE(loop_.wait_until([&] { return !signals_.empty(); }));
  loop_.call([&] { EXPECT_EQ(signals_.front(), PedalSignal::kPressed); });
}

// A pedal that was plugged in again, and may not be read, was said to be unplugged for ever.
TEST_F(PedalOnLoop, TellsWhyItIsAwayAgainWhenTheCauseChanges) {
  const auto causes = std::make_shared<std::deque<ErrorCode>>(
      std::deque{ErrorCode::kDeviceGone, ErrorCode::kNotFound, ErrorCode::kPermissionDenied});
  begin([causes, open = opening()]() -> Result<std::unique_ptr<Pedal>> {
    if (causes->empty()) return open();
    const auto cause = causes->front();
    causes->pop_front();
    return fail(cause, "it is away", "");
  });
  ASSERT_TRUE(loop_.wait_until([&] { return returned_ == 1; }));
  loop_.call([&] {
    ASSERT_EQ(lost_.size(), 2U);
    EXPECT_EQ(lost_[0].code, ErrorCode::kDeviceGone);
    EXPECT_EQ(lost_[1].code, ErrorCode::kPermissionDenied);
  });
}

// Nobody could tell when a press would be heard.
TEST_F(PedalOnLoop, TellsOnceThatItIsOpenAndThatThereIsNone) {
  begin(opening());
  ASSERT_TRUE(is_open());
  press_and_come_to_rest();
  loop_.call([&] { watch_.reset(); });
  begin([]() -> Result<std::unique_ptr<Pedal>> { return nullptr; });
  EXPECT_TRUE(loop_.wait_until([&] { return returned_ == 2; }));
  loop_.call([&] { EXPECT_TRUE(lost_.empty()); });
}

// The loop stood still with it, and the watchdog ended the daemon again and again.
TEST_F(PedalOnLoop, HoldsTheLoopUpNeitherWhereItHangsInOpeningNorInReading) {
  contact_->hang();
  begin(opening());
  ASSERT_TRUE(hangs()) << "as the loop itself sees";
  contact_->let_go();
  ASSERT_TRUE(is_open());
  press_and_come_to_rest();
  contact_->hang();
  press();
  ASSERT_TRUE(hangs());
}

TEST_F(PedalOnLoop, IsATroubleThatIsToldOnceWhileItDoesNotAnswer) {
  contact_->hang();
  begin(opening(), 20ms);
  ASSERT_TRUE(loop_.wait_until([&] { return !lost_.empty(); }));
  loop_.call([&] {
    EXPECT_EQ(lost_.front().line(),
              "the pedal does not answer: unplug it, or the board that has its line, and plug it "
              "in again");
  });
  contact_->let_go();
  ASSERT_TRUE(loop_.wait_until([&] { return returned_ > 0; }));
  loop_.call([&] { EXPECT_EQ(lost_.size(), 1U); });
}

// Whoever pressed it then has long left.
TEST_F(PedalOnLoop, StartsNothingForAPressThatCameWhileItDidNotAnswer) {
  begin(opening(), 20ms);
  ASSERT_TRUE(is_open());
  contact_->hang();
  press();
  // A busy machine may have told of its opening that it does not answer.
  ASSERT_TRUE(loop_.wait_until([&] { return contact_->holds_a_call() && !is_there_; }));
  int opened = 0;
  loop_.call([&] { opened = opens_; });
  contact_->let_go();
  ASSERT_TRUE(is_open());
  loop_.call([&] {
    EXPECT_TRUE(signals_.empty());
    EXPECT_GT(opens_, opened) << "it is opened afresh";
  });
  EXPECT_TRUE(contact_->wait_until_closed(1));
}

// It was opened, told to be there, read, told to be silent, opened again, and so on without end.
TEST_F(PedalOnLoop, IsNotThereBeforeItIsRead) {
  contact_->hang_in_reading();
  begin(opening(), 20ms);
  ASSERT_TRUE(loop_.wait_until([&] { return contact_->holds_a_call() && !lost_.empty(); }));
  loop_.call([&] { EXPECT_EQ(returned_, 0); });
  contact_->let_go();
  EXPECT_TRUE(is_open());
}

// Its level was from before the edges that are passed over.
TEST_F(PedalOnLoop, IsOpenedAsItsLastEdgeLeftIt) {
  begin([open = opening(), contact = contact_] {
    auto pedal = open();
    contact->give({{true, EventLoop::monotonic_now()}});
    return pedal;
  });
  ASSERT_TRUE(loop_.wait_until([&] { return !signals_.empty(); }));
  loop_.call([&] { EXPECT_EQ(signals_.front(), PedalSignal::kStuck); });
}

// Another thing that hangs had used up the time in which it could have been closed.
TEST_F(PedalOnLoop, IsClosedAsSoonAsItIsPutOff) {
  begin(opening());
  ASSERT_TRUE(is_open());
  loop_.stop();
  watch_->put_off();
  EXPECT_TRUE(contact_->wait_until_closed(1));
  EXPECT_TRUE(watch_->end_by(std::chrono::steady_clock::now() + 1h));
}

TEST_F(PedalOnLoop, IsLeftBehindAtTheEndWhereItHangsInClosing) {
  begin(opening());
  ASSERT_TRUE(is_open());
  loop_.stop();
  contact_->hang();
  EXPECT_FALSE(watch_->end_by(std::chrono::steady_clock::now()));
  watch_.reset();
  contact_->let_go();
  EXPECT_TRUE(contact_->wait_until_closed(1)) << "by its thread, once it can";
}

// A station without a pedal was said to have left it behind.
TEST_F(PedalOnLoop, LeavesNoneBehindWhereThereIsNoneThoughItsThreadHasNoTurn) {
  const auto thread = std::make_shared<std::atomic<pid_t>>(0);
  begin([thread]() -> Result<std::unique_ptr<Pedal>> {
    *thread = ::gettid();
    return nullptr;
  });
  ASSERT_TRUE(loop_.wait_until([&] { return returned_ == 1; }));
  loop_.stop();
  const test::HeldThread held(*thread);
  EXPECT_TRUE(watch_->end_by(std::chrono::steady_clock::now()));
}

TEST_F(PedalOnLoop, IsClosedAtTheEnd) {
  begin(opening());
  ASSERT_TRUE(is_open());
  loop_.stop();
  EXPECT_TRUE(watch_->end_by(std::chrono::steady_clock::now() + 1h));
  EXPECT_TRUE(contact_->wait_until_closed(1));
}

}  // namespace
}  // namespace instep
