#include "sim/fault_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace instep {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

TEST(FaultScript, ReadsEveryFault) {
  const auto script = parse_fault_script(
      "# a bad day\n"
      "camera front: stall after 5 frames for 2 s\n"
      "camera front: stall after 50 frames   # for ever\n"
      "\n"
      "camera left: vanish after 3 frames, return after 1.5s\r\n"
      "camera left: vanish after 9 frames\n"
      "camera right: corrupt frames 4-6\n"
      "camera right: shorten frame 7\n"
      "camera right: zero frames 8-8\n"
      "camera back: never starts\n"
      "camera all: never streams\n"
      "pedal: bounce 12 edges in 20 ms\n"
      "pedal: stuck\n"
      "  pedal : vanish after 2 edges , return after 300ms");
  ASSERT_TRUE(script) << script.error().line();
  const CameraFaults front = script->of_camera("front");
  ASSERT_EQ(front.stalls.size(), 2U);
  EXPECT_EQ(front.stalls[0].after, 5U);
  EXPECT_EQ(front.stalls[0].duration, FaultTime(2s));
  EXPECT_FALSE(front.stalls[1].duration);
  const CameraFaults left = script->of_camera("left");
  ASSERT_EQ(left.absences.size(), 2U);
  EXPECT_EQ(left.absences[0].duration, FaultTime(1500ms));
  EXPECT_FALSE(left.absences[1].duration);
  const CameraFaults right = script->of_camera("right");
  ASSERT_EQ(right.corrupt.size(), 1U);
  EXPECT_FALSE(right.corrupt[0].holds(3));
  EXPECT_TRUE(right.corrupt[0].holds(4) && right.corrupt[0].holds(6));
  EXPECT_FALSE(right.corrupt[0].holds(7));
  EXPECT_TRUE(right.shortened.at(0).holds(7));
  EXPECT_TRUE(right.zero.at(0).holds(8));
  EXPECT_TRUE(script->of_camera("back").never_starts);
  EXPECT_TRUE(right.never_streams && front.never_streams) << "all means all";
  EXPECT_FALSE(front.never_starts);
  EXPECT_EQ(script->pedal.bounce_edges, 12U);
  EXPECT_EQ(script->pedal.bounce_time, FaultTime(20ms));
  EXPECT_TRUE(script->pedal.stuck);
  ASSERT_TRUE(script->pedal.absence);
  EXPECT_EQ(script->pedal.absence->after, 2U);
  EXPECT_EQ(script->pedal.absence->duration, FaultTime(300ms));
}

TEST(FaultScript, EmptyTextIsNoFault) {
  ASSERT_TRUE(parse_fault_script(""));
  ASSERT_TRUE(parse_fault_script("\n\n   # nothing\n"));
}

class BadFaultLine : public testing::TestWithParam<const char*> {};

TEST_P(BadFaultLine, IsRefusedWithItsNumber) {
  const std::string text =
      "camera front: never starts\n# fine so far\n" + std::string(GetParam()) + "\npedal: stuck\n";
  const auto script = parse_fault_script(text);
  ASSERT_FALSE(script);
  EXPECT_EQ(script.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(script.error().message, HasSubstr("line 3"));
  EXPECT_FALSE(script.error().advice.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Lines, BadFaultLine,
    testing::Values("camera", "camera front", "camera : stuck", "camera front stall after 5 frames",
                    "camera front: stall", "camera front: stall after frames",
                    "camera front: stall after -1 frames", "camera front: stall after 5 frames for",
                    "camera front: stall after 5 frames for 2", "camera front: stall after 5 edges",
                    "camera front: stall after 5 frames for 2 h",
                    "camera front: stall after 5 frames for nan s",
                    "camera front: stall after 5 frames for 1e9 s",
                    "camera front: stall after 5 frames for 2 s please",
                    "camera front: stall after 99999999999999999999 frames",
                    "camera front: corrupt frames 6-4", "camera front: corrupt frames 0-4",
                    "camera front: corrupt frames 4", "camera front: corrupt frames -4",
                    "camera front: corrupt frames 4-", "camera front: explode",
                    "camera front: vanish after 3 frames return after 1 s",
                    "pedal: bounce 12 edges", "pedal: bounce 5000 edges in 20 ms",
                    "pedal bounce 12 edges in 20 ms", "pedals: stuck", "stall", ":"));

TEST(FaultScript, KnowsWhichCamerasThereAre) {
  const auto script = parse_fault_script("camera top: never starts\n").value();
  const auto checked = check_fault_cameras(script, {"front", "left"});
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().line(), HasSubstr("top"));
  EXPECT_THAT(checked.error().line(), HasSubstr("front, left"));
  EXPECT_TRUE(check_fault_cameras(script, {"top"}));
}

}  // namespace
}  // namespace instep
