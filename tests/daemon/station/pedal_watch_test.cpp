#include "daemon/station/pedal_watch.h"

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <deque>
#include <mutex>
#include <utility>
#include <vector>

#include "tests/support/loop_thread.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using Edges = std::vector<PedalEdge>;

/// A contact that rests open, whose edges a test makes up. Shared by the pedal and the test.
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
    const std::lock_guard lock(mutex_);
    eventfd_t ignored = 0;
    ::eventfd_read(ready_, &ignored);
    return std::exchange(edges_, {});
  }

 private:
  int ready_;
  std::mutex mutex_;
  Edges edges_;
};

class ContactPedal final : public Pedal {
 public:
  explicit ContactPedal(std::shared_ptr<Contact> contact) : contact_(std::move(contact)) {}
  int descriptor() const override { return contact_->descriptor(); }
  Result<Edges> read_edges() override { return contact_->take(); }
  Result<bool> is_pressed() override { return false; }
  Result<void> reopen() override { return {}; }

 private:
  std::shared_ptr<Contact> contact_;
};

TEST(PedalWatch, TakesNewTimesWhileThePedalIsOpen) {
  test::LoopThread loop;
  const auto contact = std::make_shared<Contact>();
  bool opened = false;
  std::vector<PedalSignal> signals;
  PedalSettings settings;
  settings.debounce = 200ms;
  std::optional<PedalWatch> watch;
  loop.call([&] {
    const auto open = [&]() -> Result<std::unique_ptr<Pedal>> {
      opened = true;
      return std::make_unique<ContactPedal>(contact);
    };
    watch.emplace(
        loop.loop(), settings, open,
        PedalWatch::Listener{[&](PedalSignal signal) { signals.push_back(signal); },
                             [](const Error& error) { ADD_FAILURE() << error.line(); }, [] {}});
  });
  ASSERT_TRUE(loop.wait_until([&] { return opened; }));
  settings.debounce = 30ms;
  loop.call([&] { watch->set(settings); });
  const auto now = EventLoop::monotonic_now();
  contact->give({{true, now}, {false, now + 100ms}});  // too short for the old time
  EXPECT_TRUE(loop.wait_until([&] { return !signals.empty(); }));
  loop.call([&] { watch.reset(); });
  ASSERT_FALSE(signals.empty());
  EXPECT_EQ(signals.front(), PedalSignal::kPressed);
}

// A pedal that was plugged in again, and may not be read, was said to be unplugged for ever.
TEST(PedalWatch, TellsWhyThePedalIsAwayAgainWhenTheCauseChanges) {
  test::LoopThread loop;
  std::deque<ErrorCode> causes = {ErrorCode::kDeviceGone, ErrorCode::kNotFound,
                                  ErrorCode::kPermissionDenied};
  std::vector<ErrorCode> told;
  bool returned = false;
  std::optional<PedalWatch> watch;
  loop.call([&] {
    const auto open = [&]() -> Result<std::unique_ptr<Pedal>> {
      if (causes.empty()) return std::make_unique<ContactPedal>(std::make_shared<Contact>());
      const auto cause = causes.front();
      causes.pop_front();
      return fail(cause, "it is away", "");
    };
    watch.emplace(loop.loop(), PedalSettings{}, open,
                  PedalWatch::Listener{[](PedalSignal) {},
                                       [&](const Error& error) { told.push_back(error.code); },
                                       [&] { returned = true; }});
  });
  EXPECT_TRUE(loop.wait_until([&] { return returned; }));
  loop.call([&] { watch.reset(); });
  EXPECT_EQ(told, (std::vector{ErrorCode::kDeviceGone, ErrorCode::kPermissionDenied}));
}

}  // namespace
}  // namespace instep
