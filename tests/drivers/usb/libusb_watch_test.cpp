#include "drivers/usb/libusb_watch.h"

#include <gtest/gtest.h>
#include <libusb-1.0/libusb.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// Stands for libusb in this program: it tells of what the test says, and notes what it is asked
/// while it tells. What is not here would go to the real library with devices that it does not
/// know.
namespace {

struct LibusbDouble {
  libusb_hotplug_callback_fn callback = nullptr;
  void* user = nullptr;
  std::vector<std::pair<int, libusb_hotplug_event>> waiting;  ///< port and event
  std::vector<const libusb_pollfd*> waits{nullptr};  ///< as libusb lists them; empty = it cannot
  bool telling = false;
  std::set<std::string> asked_while_telling;
  int told = 0;

  void note(const char* function) {
    if (telling) asked_while_telling.insert(function);
  }
};
LibusbDouble libusb;
std::array<char, 8> places;  // whose addresses stand for devices

libusb_device* device_at(int port) {
  return reinterpret_cast<libusb_device*>(&places[static_cast<std::size_t>(port)]);
}
int port_of(libusb_device* device) {
  return static_cast<int>(reinterpret_cast<char*>(device) - places.data());
}

}  // namespace

extern "C" {
int LIBUSB_CALL libusb_init(libusb_context** context) {
  libusb.note("init");
  *context = reinterpret_cast<libusb_context*>(&libusb);
  return 0;
}
void LIBUSB_CALL libusb_exit(libusb_context*) {
  libusb.note("exit");
}
uint8_t LIBUSB_CALL libusb_get_bus_number(libusb_device*) {
  return 7;
}
int LIBUSB_CALL libusb_get_port_numbers(libusb_device* device, uint8_t* ports, int) {
  ports[0] = static_cast<uint8_t>(port_of(device));
  return 1;
}
const libusb_pollfd** LIBUSB_CALL libusb_get_pollfds(libusb_context*) {
  libusb.note("get_pollfds");
  return libusb.waits.empty() ? nullptr : libusb.waits.data();
}
void LIBUSB_CALL libusb_free_pollfds(const libusb_pollfd**) {}
int LIBUSB_CALL libusb_hotplug_register_callback(libusb_context*, int, int, int, int, int,
                                                 libusb_hotplug_callback_fn callback, void* user,
                                                 libusb_hotplug_callback_handle*) {
  libusb.note("hotplug_register_callback");
  libusb.callback = callback;
  libusb.user = user;
  return 0;
}
int LIBUSB_CALL libusb_handle_events_timeout_completed(libusb_context* context, timeval*, int*) {
  libusb.note("handle_events");
  libusb.telling = true;
  for (const auto& [port, event] : std::exchange(libusb.waiting, {})) {
    ++libusb.told;
    EXPECT_EQ(libusb.callback(context, device_at(port), event, libusb.user), 0)
        << "anything else would end the watch";
  }
  libusb.telling = false;
  return 0;
}
int LIBUSB_CALL libusb_open(libusb_device*, libusb_device_handle**) {
  libusb.note("open");
  return LIBUSB_ERROR_BUSY;
}
int LIBUSB_CALL libusb_get_device_descriptor(libusb_device*, libusb_device_descriptor*) {
  libusb.note("get_device_descriptor");
  return LIBUSB_ERROR_BUSY;
}
ssize_t LIBUSB_CALL libusb_get_device_list(libusb_context*, libusb_device***) {
  libusb.note("get_device_list");
  return LIBUSB_ERROR_BUSY;
}
}

namespace instep {
namespace {

class LibusbWatchTest : public testing::Test {
 protected:
  LibusbWatchTest() { libusb = {}; }
};

// Called back by its own callback, libusb locks up. Where a device is, it has at hand.
// Nothing comes of departures without arrivals, nor of arrivals that are over.
TEST_F(LibusbWatchTest, CallbackOnlyPostsEvent) {
  const auto watch = open_libusb_watch();
  ASSERT_TRUE(watch) << watch.error().line();
  constexpr auto kArrived = LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED;
  constexpr auto kLeft = LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;
  libusb.waiting = {{3, kLeft}, {1, kArrived}, {1, kArrived}, {2, kArrived}, {1, kLeft}};
  EXPECT_TRUE((*watch)->changes().empty()) << "none of them is on this machine's bus 7";
  EXPECT_EQ(libusb.told, 5);
  EXPECT_EQ(libusb.asked_while_telling, std::set<std::string>());
}

// No descriptor is left to watch with.
TEST_F(LibusbWatchTest, SurvivesEmfile) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const int next = ::dup(0);
  ASSERT_GE(next, 0);
  ::close(next);
  const rlimit none_left{static_cast<rlim_t>(next), before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none_left), 0);
  const auto watch = open_libusb_watch();
  ::setrlimit(RLIMIT_NOFILE, &before);
  ASSERT_FALSE(watch);
  EXPECT_EQ(watch.error().code, ErrorCode::kIo);
  EXPECT_TRUE(open_libusb_watch());
}

// One that is deaf would tell of no device, ever.
TEST_F(LibusbWatchTest, FailsWhereItCannotWait) {
  libusb.waits = {};
  const auto unsaid = open_libusb_watch();
  ASSERT_FALSE(unsaid);
  EXPECT_EQ(unsaid.error().code, ErrorCode::kIo);
  const libusb_pollfd closed{-1, POLLIN};
  libusb.waits = {&closed, nullptr};
  const auto refused = open_libusb_watch();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace instep
