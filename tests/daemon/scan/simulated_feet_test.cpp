#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "daemon/scan/scan_pipeline.h"
#include "sim/simulated_station.h"
#include "tests/support/simulated_scan.h"

namespace instep {
namespace {

using test::expect_true_measures;
using test::number_held;
using test::number_known;
using test::scan_of;

struct Person {
  std::uint64_t seed;
  Side side;
};

class SimulatedFeet : public testing::TestWithParam<Person> {};

/// No camera sees the sole, and under a high arch a hand's breadth of skin has to be guessed: the
/// girths are where that shows.
TEST_P(SimulatedFeet, AreMeasuredWithinAMillimetre) {
  SimulationSettings settings;
  settings.seed = GetParam().seed;
  settings.side = GetParam().side;
  auto scan = scan_of(settings);
  ASSERT_TRUE(scan);
  const auto records = measure_capture(scan->capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  ASSERT_EQ(records->size(), 1U);
  expect_true_measures(records->front().measures, scan->truth.front().measures);
}

/// As of a foot that stepped aside before the last frames of each camera.
void shift_last_frames(Capture& capture, int pixels) {
  constexpr int kLast = 5;
  for (const auto& camera : capture.cameras) {
    int left = kLast;
    for (auto frame = capture.frames.rbegin(); frame != capture.frames.rend() && left > 0;
         ++frame) {
      if (frame->camera != camera.geometry.id) continue;
      for (auto row = frame->raw.begin(); row != frame->raw.end(); row += frame->width) {
        std::rotate(row, row + frame->width - pixels, row + frame->width);
      }
      --left;
    }
  }
}

/// All cameras see it.
TEST(SimulatedFoot, ThatMovedIsSpokenOfOnce) {
  SimulationSettings simulation;
  simulation.seed = 3;
  auto scan = scan_of(simulation);
  ASSERT_TRUE(scan);
  shift_last_frames(scan->capture, 4);
  const auto records = measure_capture(scan->capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  const auto& warnings = records->front().warnings;
  const auto spoken = std::count_if(warnings.begin(), warnings.end(), [](const auto& warning) {
    return warning.find(" moved ") != std::string::npos;
  });
  EXPECT_EQ(spoken, 1);
}

/// One camera alone sees a side of it: that it is no foot is not all that helps.
TEST(SimulatedFoot, ThatIsNoneSaysWhatWasMissedOfIt) {
  int failed = 0;
  for (const std::uint64_t seed : {6U, 7U, 8U}) {
    SimulationSettings settings;
    settings.seed = seed;
    settings.cameras = 1;
    auto scan = scan_of(settings);
    ASSERT_TRUE(scan);
    const auto measured = measure_capture(scan->capture, {}, {});
    if (measured) continue;
    ++failed;
    EXPECT_NE(measured.error().line().find("no camera saw the sole"), std::string::npos)
        << measured.error().line();
  }
  EXPECT_GT(failed, 0);
}

/// Without the others' cameras, in the order of the station: front, left, back, right.
Capture seen_by(const Capture& capture, const std::vector<std::size_t>& cameras) {
  Capture some = capture;
  some.cameras.clear();
  some.frames.clear();
  for (const std::size_t camera : cameras) some.cameras.push_back(capture.cameras[camera]);
  for (const auto& frame : capture.frames) {
    const bool is_kept =
        std::any_of(some.cameras.begin(), some.cameras.end(),
                    [&](const CameraDescription& one) { return one.geometry.id == frame.camera; });
    if (is_kept) some.frames.push_back(frame);
  }
  return some;
}

/// Two neighbours see one side of it, and the edge of that was taken for its heel or toes: the axis
/// was turned by ten degrees, and breadths were a third too small, by intervals of some 5 mm.
TEST(SimulatedFoot, ThatWasSeenFromOneSideOnlyIsRefused) {
  SimulationSettings settings;
  settings.seed = 9;
  auto scan = scan_of(settings);
  ASSERT_TRUE(scan);
  const auto refusal = [&](const std::vector<std::size_t>& cameras) {
    const auto measured = measure_capture(seen_by(scan->capture, cameras), {}, {});
    return measured ? std::string("measured") : measured.error().line();
  };
  EXPECT_NE(refusal({0, 1}).find("the right half of its heel"), std::string::npos);
  EXPECT_NE(refusal({0, 3}).find("the left half of its heel"), std::string::npos);
  EXPECT_NE(refusal({1, 2}).find("the right half of its toes"), std::string::npos);
  EXPECT_NE(refusal({2, 3}).find("the left half of its toes"), std::string::npos);
}

/// Where the border between was not seen, what hangs on it is missing or as unsure as it is.
TEST(SimulatedFoot, ThatOneSideOfWasHardlySeenIsMeasuredWithinItsIntervals) {
  int known = 0;
  int held = 0;
  for (const std::uint64_t seed : {9U, 10U}) {
    SimulationSettings settings;
    settings.seed = seed;
    auto scan = scan_of(settings);
    ASSERT_TRUE(scan);
    for (const std::vector<std::size_t>& cameras :
         {std::vector<std::size_t>{0, 1, 2}, {0, 2, 3}, {0, 2}}) {
      const auto measured = measure_capture(seen_by(scan->capture, cameras), {}, {});
      ASSERT_TRUE(measured) << measured.error().line();
      known += number_known(measured->front().measures, scan->truth.front().measures);
      held += number_held(measured->front().measures, scan->truth.front().measures);
    }
  }
  EXPECT_GT(known, 40);
  EXPECT_GE(held, known - 3);
}

TEST(SimulatedFoot, IsMeasuredByTheRulesOfTheSettings) {
  SimulationSettings simulation;
  simulation.seed = 5;
  auto scan = scan_of(simulation);
  ASSERT_TRUE(scan);
  PipelineSettings settings;
  settings.measures.axis = AxisRule::kMedialTangent;
  settings.measures.ball_girth = BallGirthRule::kShortest;
  Capture& capture = scan->capture;
  capture.truth["ball_girth"] = 250.0;
  const auto records = measure_capture(capture, settings, {});
  ASSERT_TRUE(records) << records.error().line();
  EXPECT_EQ(records->front().foot.rules, settings.measures);
  EXPECT_TRUE(records->front().truth.empty()) << "a truth by other definitions";
  const auto& measures = records->front().measures;
  EXPECT_NE(measures.find("foot_length")->definition.find("brannock"), std::string::npos);
  EXPECT_NE(measures.find("ball_girth")->definition.find("shortest"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(OfSomePeople, SimulatedFeet,
                         testing::Values(Person{2, Side::kLeft}, Person{5, Side::kRight},
                                         Person{7, Side::kRight}),
                         [](const auto& person) {
                           return "Seed" + std::to_string(person.param.seed);
                         });

}  // namespace
}  // namespace instep
