#include "drivers/evdev/evdev_pedal.h"

#include <gtest/gtest.h>
#include <libevdev/libevdev.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "tests/support/temporary_folder.h"

namespace {

/// What the library tells of the one device.
int clock_failure = 0;
int events_left = 0;

}  // namespace

// They stand before those of the library: here is no pedal that would fail so.
extern "C" {

int libevdev_new_from_fd(int, libevdev** device) {
  *device = nullptr;
  return 0;
}

int libevdev_has_event_code(const libevdev*, unsigned, unsigned) {
  return 1;
}

int libevdev_grab(libevdev*, libevdev_grab_mode) {
  return 0;
}

int libevdev_set_clock_id(libevdev*, int) {
  return -clock_failure;
}

/// The key goes down and up.
int libevdev_next_event(libevdev*, unsigned, input_event* event) {
  if (events_left == 0) return -EAGAIN;
  *event = {};
  event->type = EV_KEY;
  event->code = KEY_B;
  event->value = events_left-- % 2;
  return LIBEVDEV_READ_STATUS_SUCCESS;
}
}

namespace instep {
namespace {

class EvdevPedalFault : public testing::Test {
 protected:
  /// A pipe, as it can be waited for.
  EvdevPedalFault() {
    clock_failure = 0;
    events_left = 0;
    std::filesystem::create_directory(devices_.path() / "by-id");
    EXPECT_EQ(::mkfifo((devices_.path() / "by-id" / "usb-foot").c_str(), 0600), 0);
  }

  Result<std::unique_ptr<EvdevPedal>> open() const {
    return EvdevPedal::open({.device = "usb-foot", .key = "KEY_B", .devices = devices_.path()});
  }

  static bool is_readable(int descriptor) {
    pollfd looked_at{descriptor, POLLIN, 0};
    return ::poll(&looked_at, 1, 0) == 1;
  }

  test::TemporaryFolder devices_;
};

TEST_F(EvdevPedalFault, ReadsTheRestOfAFloodLater) {
  const auto pedal = open();
  ASSERT_TRUE(pedal) << pedal.error().line();
  EXPECT_FALSE(is_readable((*pedal)->descriptor()));
  constexpr int kFlood = 10000;
  events_left = kFlood;
  const auto first = (*pedal)->read_edges();
  ASSERT_TRUE(first);
  EXPECT_LT(first->size(), 5000U);
  std::size_t edges = first->size();
  while (is_readable((*pedal)->descriptor())) {
    const auto more = (*pedal)->read_edges();
    ASSERT_TRUE(more);
    edges += more->size();
  }
  EXPECT_EQ(edges, static_cast<std::size_t>(kFlood));
}

// With room for fewer descriptors than it takes: it spoke of a bad one.
TEST_F(EvdevPedalFault, SaysThatItHasTooFewDescriptors) {
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const int first_free = ::dup(STDERR_FILENO);
  ::close(first_free);
  for (rlim_t room = 0; room < 3; ++room) {
    const rlimit few{static_cast<rlim_t>(first_free) + room, limit.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &few);
    const auto pedal = open();
    ::setrlimit(RLIMIT_NOFILE, &limit);
    ASSERT_FALSE(pedal) << room;
    EXPECT_EQ(pedal.error().code, ErrorCode::kIo) << room;
    EXPECT_NE(pedal.error().message.find(std::strerror(EMFILE)), std::string::npos)
        << pedal.error().line();
  }
  EXPECT_TRUE(open());
}

TEST_F(EvdevPedalFault, SaysWhyItsClockCannotBeSet) {
  clock_failure = EINVAL;
  const auto pedal = open();
  ASSERT_FALSE(pedal);
  EXPECT_NE(pedal.error().message.find(std::strerror(EINVAL)), std::string::npos)
      << pedal.error().line();
  clock_failure = ENODEV;
  EXPECT_EQ(open().error().code, ErrorCode::kDeviceGone);
}

}  // namespace
}  // namespace instep
