#include "drivers/openni2/child_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

CameraOpened some_camera() {
  CameraOpened opened;
  opened.device = {"A1", "1d27/0600@1/7", "PrimeSense", "PS1080", 0x1d27, 0x0600, {}, "\xff busy"};
  opened.device.modes = {{640, 480, 30, 0.1}, {320, 240, 60, 1.0}};
  opened.mode = opened.device.modes.front();
  opened.horizontal_fov_rad = 1.0145;
  opened.vertical_fov_rad = 0.7898;
  return opened;
}

TEST(ChildMessages, ArriveAsTheyWereSent) {
  const auto opened = some_camera();
  const auto message = parse_child_message(to_text(ChildMessage(opened)));
  ASSERT_TRUE(message);
  const auto* read = std::get_if<CameraOpened>(&*message);
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->device.uri, opened.device.uri);
  EXPECT_EQ(read->device.usb_vendor, 0x1d27);
  EXPECT_EQ(read->device.modes, opened.device.modes);
  EXPECT_EQ(read->mode, opened.mode);
  EXPECT_EQ(read->horizontal_fov_rad, opened.horizontal_fov_rad);

  for (int code = 0; code <= static_cast<int>(ErrorCode::kInternal); ++code) {
    for (int remedy = 0; remedy <= static_cast<int>(Remedy::kBug); ++remedy) {
      const Error sent{static_cast<ErrorCode>(code), static_cast<Remedy>(remedy), "what", "advice"};
      const auto come = parse_child_message(to_text(ChildMessage(sent)));
      ASSERT_TRUE(come);
      const auto* error = std::get_if<Error>(&*come);
      ASSERT_NE(error, nullptr);
      EXPECT_EQ(error->code, sent.code);
      EXPECT_EQ(error->remedy, sent.remedy);
      EXPECT_EQ(error->line(), "what: advice");
    }
  }
}

TEST(ChildMessages, ThatMakeNoSenseAreErrors) {
  for (const auto* text :
       {"", "{", "[]", "3", "{}", R"({"event":"nothing"})", R"({"event":3})",
        R"({"event":"error"})", R"({"event":"opened","device":{},"mode":{}})", "\xff\xfe"}) {
    const auto message = parse_child_message(text);
    ASSERT_FALSE(message) << text;
    EXPECT_EQ(message.error().code, ErrorCode::kCorruptData);
    EXPECT_FALSE(parse_device_list(text)) << text;
  }
}

// It was taken for a camera that had opened.
TEST(ChildMessages, OfAnEventThatNobodyKnowsAreErrorsWhateverTheyHold) {
  std::string text = to_text(ChildMessage(some_camera()));
  text.replace(text.find("opened"), 6, "dimmed");
  const auto message = parse_child_message(text);
  ASSERT_FALSE(message);
  EXPECT_EQ(message.error().code, ErrorCode::kCorruptData);
}

std::string damaged(std::string text, test::RandomNumbers& random) {
  for (int i = 0; i < 3; ++i) {
    text[random.below(text.size())] = static_cast<char>(random.below(256));
  }
  return text;
}

/// What was read of a text is refused as documented, or comes back the same when it is sent again.
template <typename Message>
void expect_refused_or_whole(const Result<Message>& read,
                             Result<Message> (*parse)(std::string_view)) {
  if (!read) {
    EXPECT_EQ(read.error().code, ErrorCode::kCorruptData) << read.error().line();
    return;
  }
  const std::string again = to_text(*read);
  const auto come = parse(again);
  ASSERT_TRUE(come) << again;
  EXPECT_EQ(to_text(*come), again);
}

TEST(ChildMessages, SurviveDamage) {
  const std::string message = to_text(ChildMessage(some_camera()));
  const std::string list = to_text(std::vector{some_camera().device});
  test::RandomNumbers random(1);
  for (int round = 0; round < 5000; ++round) {
    expect_refused_or_whole(parse_child_message(damaged(message, random)), parse_child_message);
    expect_refused_or_whole(parse_device_list(damaged(list, random)), parse_device_list);
  }
}

TEST(ChildMessages, SayWhyThereIsNoList) {
  const Error error{ErrorCode::kUnsupported, Remedy::kOperator, "no driver", "install one"};
  const auto devices = parse_device_list(to_text(ChildMessage(error)));
  ASSERT_FALSE(devices);
  EXPECT_EQ(devices.error().line(), "no driver: install one");
}

}  // namespace
}  // namespace instep
