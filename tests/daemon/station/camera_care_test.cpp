#include "daemon/station/camera_care.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>

#include "daemon/station/back_off.h"
#include "drivers/files/descriptor.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// A bus of which the test tells what comes and goes, and which may hang.
class FakeUsbWatch final : public UsbWatch {
 public:
  int descriptor() const override { return ready_.number(); }
  std::vector<UsbChange> changes() override {
    std::unique_lock lock(mutex_);
    is_in_call_ = true;
    EXPECT_TRUE(freed_.wait_for(lock, 30s, [this] { return !hangs_; })) << "the loop waits for it";
    is_in_call_ = false;
    std::uint64_t count = 0;
    [[maybe_unused]] const auto got = ::read(ready_.number(), &count, sizeof count);
    return std::exchange(waiting_, {});
  }
  void tell(bool arrived, bool could_be_faster = false) {
    UsbChange change;
    change.device.address = {"usb-1-2", "A1"};
    change.device.link_mbps = 480;
    change.device.could_be_faster = could_be_faster;
    change.arrived = arrived;
    const std::lock_guard lock(mutex_);
    waiting_.push_back(change);
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(ready_.number(), &one, sizeof one);
  }

  void hang() {
    const std::lock_guard lock(mutex_);
    hangs_ = true;
  }
  void let_go() {
    const std::lock_guard lock(mutex_);
    hangs_ = false;
    freed_.notify_all();
  }
  bool holds_a_call() {
    const std::lock_guard lock(mutex_);
    return hangs_ && is_in_call_;
  }

 private:
  std::mutex mutex_;  ///< of what follows
  std::condition_variable freed_;
  bool hangs_ = false;
  bool is_in_call_ = false;
  Descriptor ready_{::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)};
  std::vector<UsbChange> waiting_;
};

class CameraCareTest : public testing::Test {
 protected:
  CameraCareTest() : loop_(EventLoop::create().value()) {
    auto watch = std::make_unique<FakeUsbWatch>();
    bus_ = watch.get();
    give_up_ = loop_->timer([this] { loop_->leave(); });
    CameraCare::Bus bus;
    bus.watch = [owned = std::make_shared<std::unique_ptr<UsbWatch>>(std::move(watch))] {
      return Result<std::unique_ptr<UsbWatch>>(std::move(*owned));
    };
    bus.reset = [this](const UsbAddress& address) -> Result<void> {
      EXPECT_EQ(address.serial, "A1");
      ++resets_;
      return fail(ErrorCode::kPermissionDenied, "it may not be reset", "change a rule");
    };
    care_.emplace(*loop_, std::vector<std::optional<UsbAddress>>{UsbAddress{"", "A1"}},
                  CameraCare::Listener{[this] { ++looks_; }, [this] { go_on(); }}, bus);
  }
  /// Takes one step after each news of a change, and ends with the news after the last.
  void run(std::deque<std::function<void()>> steps) {
    steps_ = std::move(steps);
    give_up_.set(60s);
    ASSERT_TRUE(loop_->run());
    EXPECT_TRUE(done_) << steps_.size() << " steps were not reached";
  }
  void go_on() {
    if (steps_.empty()) {
      done_ = true;
      return loop_->leave();
    }
    const auto step = std::move(steps_.front());
    steps_.pop_front();
    step();
  }

  std::unique_ptr<EventLoop> loop_;
  EventLoop::Timer give_up_;
  FakeUsbWatch* bus_ = nullptr;
  std::atomic<int> resets_ = 0;
  int looks_ = 0;
  std::deque<std::function<void()>> steps_;
  bool done_ = false;
  std::optional<CameraCare> care_;
};

// The loop waited with it while a faulty device kept its driver busy.
TEST_F(CameraCareTest, HoldsTheLoopUpNowhereWhereTheBusHangs) {
  bus_->hang();
  EventLoop::Timer look;
  look = loop_->timer([&] { bus_->holds_a_call() ? bus_->let_go() : look.set(1ms); });
  look.set(0ms);
  bus_->tell(true);
  run({});
  EXPECT_EQ(care_->health(0).link_mbps, 480);
}

TEST(CameraCareOfABusThatHangs, HoldsNobodyUpAndIsLeftBehind) {
  const auto loop = EventLoop::create().value();
  const auto release = std::make_shared<std::promise<void>>();
  CameraCare::Bus bus = CameraCare::real_bus();
  bus.watch = [until = release->get_future().share()]() -> Result<std::unique_ptr<UsbWatch>> {
    EXPECT_EQ(until.wait_for(30s), std::future_status::ready) << "the loop waits for it";
    return fail(ErrorCode::kNotFound, "there is no bus", "");
  };
  CameraCare care(*loop, {UsbAddress{"", "A1"}}, {[] {}, [] {}}, bus);
  EXPECT_FALSE(care.end_watch_by(std::chrono::steady_clock::now()));
  release->set_value();
}

const Error kSilent{ErrorCode::kTimeout, Remedy::kReopen, "no frame came", "look"};
const Error kGone{ErrorCode::kDeviceGone, Remedy::kReopen, "it left", "plug it in"};

TEST_F(CameraCareTest, LooksAtOnceWhenACameraInTroubleArrives) {
  care_->looked_at(0, kGone);
  EXPECT_EQ(care_->health(0).recovery, "waits until it is plugged in");
  bus_->tell(true);
  run({});
  EXPECT_EQ(looks_, 1);
  EXPECT_EQ(care_->health(0).link_mbps, 480);
}

TEST_F(CameraCareTest, LooksAtOnceWhenACameraThatServedLeaves) {
  care_->looked_at(0, std::nullopt);
  bus_->tell(true);
  run({[this] {
    EXPECT_EQ(looks_, 0) << "it serves";
    bus_->tell(false);
  }});
  EXPECT_EQ(looks_, 1);
  EXPECT_EQ(care_->health(0).link_mbps, 0);
}

// A USB 3 camera that came up as USB 2 works, and fails after hours.
TEST_F(CameraCareTest, WarnsOfASlowLinkAsLongAsItIsThere) {
  bus_->tell(true, true);
  run({[this] {
    EXPECT_THAT(care_->health(0).warning, HasSubstr("480 Mbit/s"));
    bus_->tell(false);
  }});
  EXPECT_EQ(care_->health(0).warning, "");
}

// A camera arrives before udev has set who may open it.
TEST_F(CameraCareTest, ArrivalThenEaccesRetries) {
  const Error denied{ErrorCode::kPermissionDenied, Remedy::kOperator, "it may not be opened",
                     "change a rule"};
  care_->looked_at(0, kGone);
  bus_->tell(true);
  run({});
  ASSERT_EQ(looks_, 1);
  // As the station does: it looks again after each pause, for two seconds at most.
  BackOff pauses;
  std::chrono::milliseconds waited{0};
  care_->looked_at(0, denied);
  while (care_->health(0).recovery != "needs a person") {
    EXPECT_THAT(care_->health(0).recovery, HasSubstr("opened again"));
    waited += pauses.next();
    ASSERT_LE(waited, 2s);
    care_->looked_at(0, denied);
  }
  EXPECT_GE(waited, 1s) << "which udev may need";
  EXPECT_EQ(resets_, 0) << "a reset gives no right";

  care_->looked_at(0, std::nullopt);
  care_->looked_at(0, denied);
  care_->looked_at(0, std::nullopt);
  EXPECT_EQ(care_->health(0).recovery, "") << "udev was there in time";
}

// Some cameras come back by no reset, but only by a replug: there must be an end.
TEST_F(CameraCareTest, ResetsASilentCameraABoundedNumberOfTimes) {
  for (int i = 0; i < 20; ++i) care_->looked_at(0, kSilent);
  run({[] {}});
  EXPECT_EQ(resets_, 2);
  EXPECT_EQ(care_->health(0).recovery, "it may not be reset: change a rule");
  care_->looked_at(0, kSilent);
  EXPECT_EQ(care_->health(0).recovery, "needs a person");
}

/// What a reset itself brings back is no reason to begin again: that would reset for ever.
TEST_F(CameraCareTest, DoesNotTakeTheEchoOfAResetForAPerson) {
  for (int i = 0; i < 20; ++i) care_->looked_at(0, kSilent);
  run({[] {},
       [this] {
         bus_->tell(false);
         bus_->tell(true);
       }});
  care_->looked_at(0, kSilent);
  EXPECT_EQ(care_->health(0).recovery, "needs a person");
}

}  // namespace
}  // namespace instep
