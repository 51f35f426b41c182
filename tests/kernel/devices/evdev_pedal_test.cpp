#include "drivers/evdev/evdev_pedal.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <linux/input.h>
#include <unistd.h>

#include "tests/kernel/devices/foot_switch.h"
#include "tests/support/pedal_contract.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {
namespace {

using testing::HasSubstr;

EvdevPedal::Settings by_ids() {
  return {.device = "0c45:7403", .key = "KEY_B"};
}

class Backend {
 public:
  Pedal& pedal() { return *pedal_; }
  void press() { switch_.send(KEY_B, 1); }
  void release() { switch_.send(KEY_B, 0); }
  void unplug() { switch_.unplug(); }
  void plug_in() { switch_.plug_in(); }

 private:
  FootSwitch switch_;
  std::unique_ptr<EvdevPedal> pedal_ = EvdevPedal::open(by_ids()).value();
};

INSTANTIATE_TYPED_TEST_SUITE_P(EvdevPedal, PedalContract, Backend);

TEST(EvdevPedal, KeepsItsKeysFromOthers) {
  FootSwitch foot_switch;
  const int other = ::open(foot_switch.node().c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(other, 0);
  input_event event{};
  {
    const auto pedal = EvdevPedal::open(by_ids());
    ASSERT_TRUE(pedal) << pedal.error().line();
    foot_switch.send(KEY_B, 1);
    foot_switch.send(KEY_B, 0);
    EXPECT_EQ((*pedal)->read_edges().value().size(), 2U);
    EXPECT_LT(::read(other, &event, sizeof event), 0);
  }
  foot_switch.send(KEY_B, 1);
  EXPECT_GT(::read(other, &event, sizeof event), 0) << "it is free again";
  ::close(other);
}

TEST(EvdevPedal, HearsOneKeyAndNoRepetition) {
  FootSwitch foot_switch;
  const auto pedal = EvdevPedal::open(by_ids());
  ASSERT_TRUE(pedal);
  foot_switch.send(KEY_C, 1);
  foot_switch.send(KEY_B, 1);
  for (int i = 0; i < 5; ++i) foot_switch.send(KEY_B, 2);
  foot_switch.send(KEY_C, 0);
  const auto edges = (*pedal)->read_edges();
  ASSERT_TRUE(edges);
  ASSERT_EQ(edges->size(), 1U);
  EXPECT_TRUE(edges->front().pressed);
  EXPECT_TRUE((*pedal)->is_pressed().value());
}

TEST(EvdevPedal, IsDownIfItWasDownWhenItWasOpened) {
  FootSwitch foot_switch;
  foot_switch.send(KEY_B, 1);
  const auto pedal = EvdevPedal::open(by_ids());
  ASSERT_TRUE(pedal);
  EXPECT_TRUE((*pedal)->is_pressed().value());
  EXPECT_TRUE((*pedal)->read_edges().value().empty());
}

// The kernel keeps some tens of events, drops the rest and says so.
TEST(EvdevPedal, KnowsTheStateAfterABurstThatOverflowed) {
  FootSwitch foot_switch;
  const auto pedal = EvdevPedal::open(by_ids());
  ASSERT_TRUE(pedal);
  for (int i = 0; i < 1000; ++i) {
    foot_switch.send(KEY_B, 1);
    foot_switch.send(KEY_B, 0);
  }
  foot_switch.send(KEY_B, 1);
  const auto edges = (*pedal)->read_edges();
  ASSERT_TRUE(edges);
  EXPECT_LT(edges->size(), 2001U) << "the kernel is known to drop events";
  EXPECT_TRUE((*pedal)->is_pressed().value());
  foot_switch.send(KEY_B, 0);
  EXPECT_EQ((*pedal)->read_edges().value().size(), 1U);
  EXPECT_FALSE((*pedal)->is_pressed().value());
}

TEST(EvdevPedal, IsFoundByItsName) {
  FootSwitch foot_switch;
  TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "by-id");
  std::filesystem::create_symlink(foot_switch.node(), folder.path() / "by-id" / "usb-foot");
  const auto pedal =
      EvdevPedal::open({.device = "usb-foot", .key = "KEY_C", .devices = folder.path()});
  ASSERT_TRUE(pedal) << pedal.error().line();
  foot_switch.send(KEY_C, 1);
  EXPECT_EQ((*pedal)->read_edges().value().size(), 1U);
}

TEST(EvdevPedal, RefusesWhatItCannotTellApart) {
  FootSwitch one;
  FootSwitch two;
  const auto pedal = EvdevPedal::open(by_ids());
  ASSERT_FALSE(pedal);
  EXPECT_EQ(pedal.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(pedal.error().advice, HasSubstr("by-id"));
}

TEST(EvdevPedal, SaysThatAnotherProgramHoldsIt) {
  FootSwitch foot_switch;
  const auto holder = EvdevPedal::open(by_ids());
  ASSERT_TRUE(holder);
  const auto pedal = EvdevPedal::open(by_ids());
  ASSERT_FALSE(pedal);
  EXPECT_EQ(pedal.error().code, ErrorCode::kBusy);
}

TEST(EvdevPedal, SaysWhatIsNotThere) {
  EXPECT_EQ(EvdevPedal::open(by_ids()).error().code, ErrorCode::kNotFound);
  FootSwitch foot_switch;
  const auto other_key = EvdevPedal::open({.device = "0c45:7403", .key = "KEY_A"});
  ASSERT_FALSE(other_key);
  EXPECT_THAT(other_key.error().message, HasSubstr("no key KEY_A"));
}

}  // namespace
}  // namespace instep::test
