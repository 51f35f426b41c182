#include "drivers/openni2/mode_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace instep {
namespace {

/// What a Carmine offers, and what none should be asked for.
const std::vector<DepthMode> kOffered = {
    {320, 240, 30, 1.0}, {320, 240, 60, 1.0}, {640, 480, 30, 1.0},
    {640, 480, 25, 0.1}, {640, 480, 30, 0.1}, {640, 480, 60, 0.1},
    {320, 240, 30, 0.1}, {160, 120, 30, 0.1}, {1280, 1024, 10, 1.0}};

TEST(ModeChoice, TakesTheUsualSizeInTheFinestUnitAt30) {
  EXPECT_EQ(choose_mode(kOffered, std::nullopt).value(), (DepthMode{640, 480, 30, 0.1}));
}

TEST(ModeChoice, TakesTheSizeThatIsAskedFor) {
  EXPECT_EQ(choose_mode(kOffered, ImageSize{320, 240}).value(), (DepthMode{320, 240, 30, 0.1}));
  EXPECT_EQ(choose_mode(kOffered, ImageSize{1280, 1024}).value(), (DepthMode{1280, 1024, 10, 1.0}));
}

TEST(ModeChoice, TakesMillimetresWhereThereIsNothingFiner) {
  EXPECT_EQ(choose_mode({{640, 480, 30, 1.0}, {320, 240, 30, 0.1}}, std::nullopt).value(),
            (DepthMode{640, 480, 30, 1.0}));
}

TEST(ModeChoice, TakesTheMostPixelsWhereTheUsualSizeIsMissing) {
  EXPECT_EQ(choose_mode({{160, 120, 30, 0.1}, {512, 424, 30, 1.0}}, std::nullopt).value(),
            (DepthMode{512, 424, 30, 1.0}));
}

TEST(ModeChoice, PassesOverImagesThatAreTooLarge) {
  EXPECT_EQ(choose_mode({{1920, 1080, 30, 0.1}, {512, 424, 30, 1.0}}, std::nullopt).value(),
            (DepthMode{512, 424, 30, 1.0}));
  EXPECT_FALSE(choose_mode({{1920, 1080, 30, 0.1}}, ImageSize{1920, 1080}));
}

TEST(ModeChoice, IsRefusedWithWhatThereIs) {
  const auto none = choose_mode({{320, 240, 30, 1.0}}, ImageSize{640, 480});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(none.error().message, testing::HasSubstr("320x240 at 30/s in 1 mm"));
  EXPECT_FALSE(choose_mode({}, std::nullopt));
  EXPECT_FALSE(choose_mode({{640, 480, 30, 0.0}}, std::nullopt));  // disparities
}

}  // namespace
}  // namespace instep
