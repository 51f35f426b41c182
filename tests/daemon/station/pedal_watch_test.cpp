#include "daemon/station/pedal_watch.h"

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/loop_thread.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using Edges = std::vector<PedalEdge>;

/// A contact that rests open, whose edges a test makes up, behind a bus that may hang. Shared by
/// the pedal and the test.
class Contact {
 public:
  Contact() : ready_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
  ~Contact() { ::close(ready_); }
  Contact(const Contact&) = delete;
  Contact& operator=(const Contact&) = delete;

  int descriptor() const { return ready_; }
  void give(Edges edges) {
    const std::lock_guard lock(mutex_);
    edges_ = std::move(edges);
    ::eventfd_write(ready_, 1);
  }
  Edges take() {
    pass();
    const std::lock_guard lock(mutex_);
    eventfd_t ignored = 0;
    ::eventfd_read(ready_, &ignored);
    return std::exchange(edges_, {});
  }

  /// From now on a call of the pedal does not return before let_go(), or for a minute.
  void hang() {
    const std::lock_guard lock(mutex_);
    hangs_ = true;
  }
  void let_go() {
    const std::lock_guard lock(mutex_);
    hangs_ = false;
    changed_.notify_all();
  }
  /// The way over the bus, which every call takes.
  void pass() {
    std::unique_lock lock(mutex_);
    ++in_call_;
    changed_.notify_all();
    changed_.wait_for(lock, 1min, [this] { return !hangs_; });
    --in_call_;
  }
  bool holds_a_call() {
    const std::lock_guard lock(mutex_);
    return hangs_ && in_call_ > 0;
  }

  void note_closed() {
    const std::lock_guard lock(mutex_);
    ++closed_;
    changed_.notify_all();
  }
  bool wait_until_closed(int times) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, 10s, [&] { return closed_ >= times; });
  }

 private:
  int ready_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Edges edges_;
  bool hangs_ = false;
  int in_call_ = 0;
  int closed_ = 0;
};

class ContactPedal final : public Pedal {
 public:
  explicit ContactPedal(std::shared_ptr<Contact> contact) : contact_(std::move(contact)) {
    (void)contact_->take();  // what came before is none of this one's
  }
  ~ContactPedal() override {
    contact_->pass();
    contact_->note_closed();
  }
  int descriptor() const override { return contact_->descriptor(); }
  Result<Edges> read_edges() override { return contact_->take(); }
  Result<bool> is_pressed() override {
    contact_->pass();
    return false;
  }
  Result<void> reopen() override {
    contact_->pass();
    return {};
  }

 private:
  std::shared_ptr<Contact> contact_;
};

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
                               [this](const Error& error) { lost_.push_back(error); },
                               [this] { ++returned_; }},
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
  int opens_ = 0;
  std::optional<PedalWatch> watch_;
};

TEST_F(PedalOnLoop, TakesNewTimesWhileItIsOpen) {
  PedalSettings settings;
  settings.debounce = 200ms;
  begin(opening(), 1h, settings);
  ASSERT_TRUE(loop_.wait_until([&] { return opens_ == 1; }));
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

// The loop stood still with it, and the watchdog ended the daemon again and again.
TEST_F(PedalOnLoop, HoldsTheLoopUpNeitherWhereItHangsInOpeningNorInReading) {
  contact_->hang();
  begin(opening());
  ASSERT_TRUE(hangs()) << "as the loop itself sees";
  contact_->let_go();
  ASSERT_TRUE(loop_.wait_until([&] { return opens_ == 1; }));
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
  begin(opening(), 500ms);
  ASSERT_TRUE(loop_.wait_until([&] { return opens_ == 1; }));
  press_and_come_to_rest();
  contact_->hang();
  press();
  ASSERT_TRUE(loop_.wait_until([&] { return !lost_.empty(); }));
  contact_->let_go();
  ASSERT_TRUE(loop_.wait_until([&] { return returned_ > 0; }));
  loop_.call([&] {
    EXPECT_TRUE(signals_.empty());
    EXPECT_GE(opens_, 2) << "it is opened afresh";
  });
  EXPECT_TRUE(contact_->wait_until_closed(1));
}

TEST_F(PedalOnLoop, IsLeftBehindAtTheEndWhereItHangsInClosing) {
  begin(opening());
  ASSERT_TRUE(loop_.wait_until([&] { return opens_ == 1; }));
  loop_.stop();
  contact_->hang();
  EXPECT_FALSE(watch_->end_by(std::chrono::steady_clock::now()));
  watch_.reset();
  contact_->let_go();
  EXPECT_TRUE(contact_->wait_until_closed(1)) << "by its thread, once it can";
}

TEST_F(PedalOnLoop, IsClosedAtTheEnd) {
  begin(opening());
  ASSERT_TRUE(loop_.wait_until([&] { return opens_ == 1; }));
  loop_.stop();
  EXPECT_TRUE(watch_->end_by(std::chrono::steady_clock::now() + 1h));
  EXPECT_TRUE(contact_->wait_until_closed(1));
}

}  // namespace
}  // namespace instep
