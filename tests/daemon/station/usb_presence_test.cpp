#include "daemon/station/usb_presence.h"

#include <gtest/gtest.h>

#include <random>

namespace instep {
namespace {

using namespace std::chrono_literals;

UsbChange change(bool arrived, const std::string& path = "usb-1-2") {
  UsbChange one;
  one.device.address.bus_path = path;
  one.arrived = arrived;
  return one;
}

constexpr auto kSettle = UsbPresence::kSettle;

TEST(UsbPresence, ReportsADeviceOnceItHasSettled) {
  UsbPresence presence;
  presence.note(change(true), 0ms);
  EXPECT_TRUE(presence.settled(kSettle - 1ms).empty());
  EXPECT_EQ(presence.next_deadline(), UsbPresence::Time(kSettle));
  const auto news = presence.settled(kSettle);
  ASSERT_EQ(news.size(), 1U);
  EXPECT_TRUE(news[0].arrived);
  EXPECT_TRUE(presence.settled(kSettle + 1s).empty());
  EXPECT_FALSE(presence.next_deadline());
}

// libusb may tell of an arrival twice, and of a departure without an arrival.
TEST(UsbPresence, MakesOneOfDuplicatesAndNothingOfOrphans) {
  UsbPresence presence;
  presence.note(change(true), 0ms);
  presence.note(change(true), 1ms);
  presence.note(change(false, "usb-1-3"), 2ms);
  EXPECT_EQ(presence.settled(1s).size(), 1U);
  presence.note(change(false), 2s);
  presence.note(change(false), 2s + 1ms);
  EXPECT_EQ(presence.settled(3s).size(), 1U);
  presence.note(change(false), 4s);
  EXPECT_TRUE(presence.settled(5s).empty());
}

// A loose plug tells hundreds of events within a second or two.
TEST(UsbPresence, MakesOnePieceOfNewsOfAFlappingPlug) {
  UsbPresence presence;
  auto now = UsbPresence::Time(0);
  for (int i = 0; i < 400; ++i, now += 5ms) {
    presence.note(change(i % 2 == 0), now);
    EXPECT_TRUE(presence.settled(now).empty());
  }
  presence.note(change(true), now);
  const auto news = presence.settled(now + kSettle);
  ASSERT_EQ(news.size(), 1U);
  EXPECT_TRUE(news[0].arrived);
}

// Who was replugged quickly is another device to the kernel and has to be opened anew.
TEST(UsbPresence, ReportsAnArrivalWhenADeviceWasReplugged) {
  UsbPresence presence;
  presence.note(change(true), 0ms);
  EXPECT_EQ(presence.settled(1s).size(), 1U);
  presence.note(change(false), 2s);
  presence.note(change(true), 2s + 50ms);
  const auto news = presence.settled(3s);
  ASSERT_EQ(news.size(), 1U);
  EXPECT_TRUE(news[0].arrived);
}

TEST(UsbPresence, ReportsADepartureOfWhatCameAndWent) {
  UsbPresence presence;
  presence.note(change(true), 0ms);
  presence.note(change(false), 50ms);
  const auto news = presence.settled(1s);
  ASSERT_EQ(news.size(), 1U);
  EXPECT_FALSE(news[0].arrived);
  EXPECT_TRUE(presence.settled(2s).empty());
}

/// Whatever the events, what was reported last of each device is what is true in the end.
TEST(UsbPresence, ReportsTheTruthInTheEnd) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    UsbPresence presence;
    std::map<std::string, bool> there;
    std::map<std::string, bool> reported;
    auto now = UsbPresence::Time(0);
    const auto take = [&] {
      for (const auto& news : presence.settled(now)) {
        reported[news.device.address.bus_path] = news.arrived;
      }
    };
    for (int i = 0; i < 60; ++i) {
      const std::string path = "usb-1-" + std::to_string(random() % 3);
      const bool arrived = random() % 2 == 0;
      presence.note(change(arrived, path), now);
      there[path] = arrived;
      now += std::chrono::milliseconds(random() % 500);
      take();
    }
    now += 1s;
    take();
    for (const auto& [path, is_there] : there) {
      EXPECT_EQ(reported[path], is_there) << path << " in round " << round;
    }
    EXPECT_FALSE(presence.next_deadline());
  }
}

}  // namespace
}  // namespace instep
