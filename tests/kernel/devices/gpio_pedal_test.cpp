#include "drivers/gpio/gpio_pedal.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>
#include <optional>

#include "tests/kernel/devices/gpio_chip.h"
#include "tests/support/pedal_contract.h"

namespace instep::test {
namespace {

using testing::HasSubstr;

constexpr unsigned kOffset = 3;

GpioPedal::Settings by_name() {
  GpioPedal::Settings settings;
  settings.address.line = "foot";
  return settings;
}

GpioPedal::Settings by_offset() {
  GpioPedal::Settings settings;
  settings.address.chip = "board";
  settings.address.offset = kOffset;
  return settings;
}

template <GpioPedal::Settings (*kSettings)()>
class Backend {
 public:
  Pedal& pedal() { return *pedal_; }
  void press() { chip_.close_contact(); }
  void release() { chip_.open_contact(); }
  void unplug() { chip_.unplug(); }
  void plug_in() { chip_.plug_in(); }

 private:
  GpioChip chip_{"pedal", "board", kOffset, "foot"};
  std::unique_ptr<GpioPedal> pedal_ = GpioPedal::open(kSettings()).value();
};

using Backends = testing::Types<Backend<by_name>, Backend<by_offset>>;
INSTANTIATE_TYPED_TEST_SUITE_P(GpioPedal, PedalContract, Backends);

TEST(GpioPedal, IsPulledUpAndActiveLow) {
  GpioChip chip("pedal", "board", kOffset, "foot");
  chip.close_contact();  // which the bias that is asked for undoes
  const auto pedal = GpioPedal::open(by_name());
  ASSERT_TRUE(pedal) << pedal.error().line();
  EXPECT_EQ(chip.bias(), "pull-up");
  EXPECT_FALSE((*pedal)->is_pressed().value());
  chip.close_contact();
  EXPECT_TRUE((*pedal)->is_pressed().value());
}

TEST(GpioPedal, CanBeActiveHighAndPulledDown) {
  GpioChip chip("pedal", "board", kOffset, "foot");
  auto settings = by_name();
  settings.active_low = false;
  settings.bias = GpioBias::kPullDown;
  const auto pedal = GpioPedal::open(settings);
  ASSERT_TRUE(pedal) << pedal.error().line();
  EXPECT_EQ(chip.bias(), "pull-down");
  EXPECT_FALSE((*pedal)->is_pressed().value());
  chip.open_contact();
  EXPECT_TRUE((*pedal)->is_pressed().value());
}

// Numbers change, names stay.
TEST(GpioPedal, IsFoundThoughItsChipGotAnotherNumber) {
  std::optional<GpioChip> other(std::in_place, "first", "other board", 0, "else");
  GpioChip chip("pedal", "board", kOffset, "foot");
  const std::string before = chip.node();
  auto pedal = GpioPedal::open(by_name());
  ASSERT_TRUE(pedal) << pedal.error().line();
  chip.unplug();
  other->unplug();
  EXPECT_EQ((*pedal)->read_edges().error().code, ErrorCode::kDeviceGone);
  EXPECT_FALSE((*pedal)->reopen());
  chip.plug_in();
  EXPECT_NE(chip.node(), before);
  const auto reopened = (*pedal)->reopen();
  ASSERT_TRUE(reopened) << reopened.error().line();
  chip.close_contact();
  EXPECT_TRUE((*pedal)->is_pressed().value());
}

TEST(GpioPedal, RefusesANameThatTwoChipsHave) {
  GpioChip one("one", "board", kOffset, "foot");
  GpioChip two("two", "other board", 0, "foot");
  const auto pedal = GpioPedal::open(by_name());
  ASSERT_FALSE(pedal);
  EXPECT_EQ(pedal.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(pedal.error().message, HasSubstr(two.node()));
  auto settings = by_name();
  settings.address.chip = "other board";
  EXPECT_TRUE(GpioPedal::open(settings));
}

TEST(GpioPedal, SaysWhatIsNotThere) {
  EXPECT_THAT(GpioPedal::open(by_name()).error().message, HasSubstr("no GPIO chip"));
  GpioChip chip("pedal", "board", kOffset, "foot");
  auto settings = by_name();
  settings.address.line = "hand";
  const auto pedal = GpioPedal::open(settings);
  ASSERT_FALSE(pedal);
  EXPECT_EQ(pedal.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(pedal.error().message, HasSubstr("line \"hand\""));
  settings = by_offset();
  settings.address.offset = 4000;
  EXPECT_EQ(GpioPedal::open(settings).error().code, ErrorCode::kNotFound);
}

// Another program has the line.
TEST(GpioPedal, NamesWhoHoldsABusyLine) {
  GpioChip chip("pedal", "board", kOffset, "foot");
  const auto holder = GpioPedal::open(by_name());
  ASSERT_TRUE(holder);
  const auto pedal = GpioPedal::open(by_offset());
  ASSERT_FALSE(pedal);
  EXPECT_EQ(pedal.error().code, ErrorCode::kBusy);
  EXPECT_EQ(pedal.error().remedy, Remedy::kOperator);
  EXPECT_THAT(pedal.error().message, HasSubstr("\"instep pedal\""));
}

TEST(GpioPedal, SaysThatThisUserMayNot) {
  GpioChip chip("pedal", "board", kOffset, "foot");
  const pid_t child = fork();
  if (child == 0) {
    // A user without rights.
    if (setuid(65534) != 0) _exit(2);
    const auto pedal = GpioPedal::open(by_name());
    _exit(!pedal && pedal.error().code == ErrorCode::kPermissionDenied ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

std::size_t open_files() {
  return static_cast<std::size_t>(std::distance(
      std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator()));
}

TEST(GpioPedal, LosesNoDescriptorWhileItsChipComesAndGoes) {
  GpioChip chip("pedal", "board", kOffset, "foot");
  const auto pedal = GpioPedal::open(by_name());
  ASSERT_TRUE(pedal);
  const auto before = open_files();
  for (int round = 0; round < 100; ++round) {
    chip.unplug();
    ASSERT_FALSE((*pedal)->read_edges());
    ASSERT_FALSE((*pedal)->reopen());
    chip.plug_in();
    ASSERT_TRUE((*pedal)->reopen());
  }
  EXPECT_EQ(open_files(), before);
}

// What is dropped is the newest edge, so the level has the last word.
TEST(GpioPedal, KnowsTheLevelAfterABurstThatOverflowed) {
  GpioChip chip("pedal", "board", kOffset, "foot");
  const auto pedal = GpioPedal::open(by_name());
  ASSERT_TRUE(pedal);
  for (int i = 0; i < 50; ++i) {
    chip.close_contact();
    chip.open_contact();
  }
  chip.close_contact();
  const auto edges = (*pedal)->read_edges();
  ASSERT_TRUE(edges);
  EXPECT_LT(edges->size(), 101U) << "the kernel is known to drop edges";
  EXPECT_TRUE((*pedal)->is_pressed().value());
}

}  // namespace
}  // namespace instep::test
