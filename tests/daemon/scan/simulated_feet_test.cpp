#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "daemon/cloud_files/cloud_file.h"
#include "daemon/cloud_files/cloud_ply_writer.h"
#include "daemon/scan/scan_pipeline.h"
#include "sim/simulated_station.h"
#include "tests/support/bent_capture.h"
#include "tests/support/simulated_scan.h"

namespace instep {
namespace {

using test::number_held;
using test::number_known;
using test::scan_of;

struct Person {
  std::uint64_t seed;
  Side side;
};

void expect_true_measures(const MeasureSet& measures, const std::map<std::string, double>& truth) {
  for (const auto& [id, value] : truth) {
    const Measure* measure = measures.find(id);
    if (id == "arch_height") {
      EXPECT_EQ(measure, nullptr) << "no camera sees the arch";
      continue;
    }
    ASSERT_NE(measure, nullptr) << id;
    // A tape round the heel runs over its lower edge, which no camera sees.
    const double guessed_mm = id == "short_heel_girth" || id == "long_heel_girth" ? 1.5 : 1.0;
    // Where the scan leaves a landmark in doubt by more, the measure says so.
    EXPECT_NEAR(measure->value(), value, std::max(guessed_mm, measure->u95().value_or(0.0))) << id;
  }
}

bool is_said(const std::string& words, const std::vector<std::string>& warnings) {
  return std::any_of(warnings.begin(), warnings.end(), [&words](const auto& warning) {
    return warning.find(words) != std::string::npos;
  });
}

bool is_withheld(const std::string& id, const MeasureSet& measures) {
  return std::any_of(measures.withheld.begin(), measures.withheld.end(),
                     [&id](const auto& one) { return one.id == id && !one.reason.empty(); });
}

/// Each camera is said to stand so far from where it stands, and turned by a tenth of a degree a
/// millimetre.
void misplace_cameras(double shift_mm, Capture& capture) {
  Eigen::Vector3d direction = Eigen::Vector3d(2.0, 1.0, 1.0).normalized();
  for (auto& camera : capture.cameras) {
    RigidTransform off = RigidTransform::Identity();
    off.linear() =
        Eigen::AngleAxisd(shift_mm * std::numbers::pi / 1800.0, direction).toRotationMatrix();
    off.translation() = shift_mm * direction;
    camera.geometry.station_from_camera = off * camera.geometry.station_from_camera;
    direction = Eigen::Vector3d(-direction.y(), direction.z(), direction.x());
  }
}

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

TEST(SimulatedFoot, IsMeasuredWithinAMillimetreByCamerasThatStandElsewhere) {
  SimulationSettings settings;
  settings.seed = 5;
  auto scan = scan_of(settings);
  ASSERT_TRUE(scan);
  Capture& capture = scan->capture;
  misplace_cameras(2.0, capture);
  const auto records = measure_capture(capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  expect_true_measures(records->front().measures, scan->truth.front().measures);
  EXPECT_TRUE(is_said("they were refined", records->front().warnings));
}

/// The depths and the lens of each camera are off, by shares that its neighbours do not have.
void spoil_lenses(Capture& capture) {
  double share = 0.003;
  for (auto& camera : capture.cameras) {
    camera.geometry.intrinsics.fx *= 1.0 - share;
    camera.geometry.intrinsics.fy *= 1.0 - share;
    for (auto& frame : capture.frames) {
      if (frame.camera == camera.geometry.id) frame.depth_unit_mm *= 1.0 + share;
    }
    share = share > 0.0 ? -share + 0.001 : -share;
  }
}

Result<test::SimulatedScan> scan_by_spoilt_lenses() {
  SimulationSettings settings;
  settings.seed = 5;
  auto scan = scan_of(settings);
  if (scan) spoil_lenses(scan->capture);
  return scan;
}

TEST(SimulatedFoot, IsMeasuredWithinItsIntervalsByLensesThatAreOff) {
  const auto scan = scan_by_spoilt_lenses();
  ASSERT_TRUE(scan);
  const auto records = measure_capture(scan->capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  const auto& measures = records->front().measures;
  const auto& truth = scan->truth.front().measures;
  // One in twenty need not hold.
  EXPECT_GE(number_known(measures, truth), 15);
  EXPECT_GE(number_held(measures, truth), number_known(measures, truth) - 1);
  EXPECT_TRUE(is_said("of its size", records->front().warnings));
}

/// No pose and no lens explains that, and no frame averages it out: neighbouring points err alike.
/// As if they erred each for itself, three in four would hold.
TEST(SimulatedFoot, IsMeasuredWithinItsIntervalsByDepthsThatAreBent) {
  constexpr double kBentMm = 0.3;
  int known = 0;
  int held = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    SimulationSettings settings;
    settings.seed = seed;
    settings.width_px = 320;
    settings.height_px = 240;
    auto scan = scan_of(settings);
    ASSERT_TRUE(scan);
    test::bend_depths({kBentMm, 4.0}, seed, scan->capture);
    const auto records = measure_capture(scan->capture, {}, {});
    ASSERT_TRUE(records) << records.error().line();
    EXPECT_NEAR(records->front().quality.at("depths_bent_mm"), kBentMm, 0.25 * kBentMm);
    known += number_known(records->front().measures, scan->truth.front().measures);
    held += number_held(records->front().measures, scan->truth.front().measures);
  }
  EXPECT_GE(known, 45);
  EXPECT_GE(held, 0.88 * known);
}

/// What is unknown of the cameras goes into the file with the points.
TEST(SimulatedFoot, KeepsItsIntervalsWhereItsCloudIsMeasuredAnew) {
  const auto scan = scan_by_spoilt_lenses();
  ASSERT_TRUE(scan);
  const auto records = measure_capture(scan->capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  const auto bytes = cloud_to_ply(records->front().foot.cloud);
  ASSERT_TRUE(bytes) << bytes.error().line();
  const auto file = read_cloud_bytes(*bytes, "cloud.ply", LengthUnit::kMillimetre);
  ASSERT_TRUE(file) << file.error().line();
  const auto foot = align_foot(file->cloud).and_then(find_landmarks);
  ASSERT_TRUE(foot) << foot.error().line();
  const auto anew = measure_foot(*foot);
  ASSERT_TRUE(anew) << anew.error().line();
  for (const char* id : {"foot_length", "foot_breadth", "ball_girth", "instep_girth"}) {
    const Measure* before = records->front().measures.find(id);
    const Measure* after = anew->find(id);
    ASSERT_TRUE(before != nullptr && after != nullptr && before->parts && after->parts) << id;
    EXPECT_NEAR(after->parts->surface, before->parts->surface, 0.1 * before->parts->surface) << id;
  }
}

/// The lower part of their inner sides nobody sees: the girths there are not sure.
TEST(SimulatedPair, HasIntervalsThatHoldWhereOneFootHidesTheOther) {
  for (const std::uint64_t seed : {7U, 9U}) {
    SimulationSettings settings;
    settings.seed = seed;
    settings.subject = Subject::kFeet;
    auto scan = scan_of(settings);
    ASSERT_TRUE(scan);
    const auto records = measure_capture(scan->capture, {}, {});
    ASSERT_TRUE(records) << records.error().line();
    ASSERT_EQ(records->size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      const Measure* ball = (*records)[i].measures.find("ball_girth");
      ASSERT_NE(ball, nullptr) << seed;
      ASSERT_TRUE(ball->u95_mm);
      const double truth = scan->truth[i].measures.at("ball_girth");
      EXPECT_NEAR(ball->value_mm, truth, *ball->u95_mm) << seed;
      EXPECT_TRUE(is_said("the wall of the foot was not seen", ball->warnings)) << seed;
    }
  }
}

TEST(SimulatedFoot, IsNotMeasuredByWrongPosesWithoutAWord) {
  SimulationSettings settings;
  settings.seed = 5;
  auto scan = scan_of(settings);
  ASSERT_TRUE(scan);
  PipelineSettings trusting;
  trusting.refine_views = false;
  Capture& capture = scan->capture;
  misplace_cameras(0.3, capture);
  const auto measured = measure_capture(capture, trusting, {});
  ASSERT_TRUE(measured) << measured.error().line();
  EXPECT_TRUE(is_said("let them be refined", measured->front().warnings));
  // The platform, seen twice, is then taken for skin: no foot is that long.
  misplace_cameras(4.0, capture);
  const auto refused = measure_capture(capture, trusting, {});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().line().find("let them be refined"), std::string::npos)
      << refused.error().line();
}

/// Two cameras see it, each by more than a millimetre.
TEST(SimulatedFoot, ThatMovedIsSpokenOfOnce) {
  SimulationSettings simulation;
  simulation.seed = 3;
  simulation.noise = NoiseLaw::kPessimistic;
  auto scan = scan_of(simulation);
  ASSERT_TRUE(scan);
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

/// The views of what stands there agree on nothing then; the long heel girth was 15 times further
/// off than its interval.
TEST(SimulatedFoot, IsMeasuredWithoutACameraThatStandsElsewhere) {
  SimulationSettings settings;
  settings.seed = 7;
  auto scan = scan_of(settings);
  ASSERT_TRUE(scan);
  RigidTransform& left = scan->capture.cameras[1].geometry.station_from_camera;
  left = RigidTransform(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ())) * left;
  const auto records = measure_capture(scan->capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  const ScanRecord& record = records->front();
  EXPECT_TRUE(
      is_said("camera left does not agree with the others and was left out", record.warnings));
  const int known = number_known(record.measures, scan->truth.front().measures);
  EXPECT_GE(known, 8);
  EXPECT_EQ(number_held(record.measures, scan->truth.front().measures), known);
}

/// Breadths were up to eight intervals off.
TEST(SimulatedFoot, IsRefusedWhereTwoCamerasHaveEachOthersPose) {
  SimulationSettings settings;
  settings.seed = 7;
  auto scan = scan_of(settings);
  ASSERT_TRUE(scan);
  for (const std::size_t first : {0U, 1U}) {
    Capture swapped = scan->capture;
    std::swap(swapped.cameras[first].geometry.station_from_camera,
              swapped.cameras[first + 2].geometry.station_from_camera);
    const auto records = measure_capture(swapped, {}, {});
    ASSERT_FALSE(records) << first;
    EXPECT_NE(records.error().line().find("the cameras contradict each other"), std::string::npos)
        << records.error().line();
  }
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

TEST(SimulatedPair, IsPutSideBySideAndLedByTheLongerFoot) {
  SimulationSettings settings;
  settings.seed = 3;
  settings.subject = Subject::kFeet;
  auto scan = scan_of(settings);
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->truth.size(), 2U);
  const double true_left = scan->truth.front().measures.at("foot_length");
  const double true_right = scan->truth.back().measures.at("foot_length");
  ASSERT_GT(true_left, true_right + 1.0);

  const auto records = measure_capture(scan->capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  ASSERT_EQ(records->size(), 2U);
  for (const auto& record : *records) {
    ASSERT_TRUE(record.pair);
    EXPECT_EQ(record.pair->left_id, records->front().id);
    EXPECT_EQ(record.pair->right_id, records->back().id);
    EXPECT_EQ(record.pair->feet.leading(), Side::kLeft);
    const MeasurePair* length = record.pair->feet.find("foot_length");
    ASSERT_NE(length, nullptr);
    EXPECT_NEAR(length->difference_mm(), true_right - true_left, 1.0);
    EXPECT_EQ(record.pair->sizes.mondopoint_mm, records->front().sizes.mondopoint_mm);
    EXPECT_TRUE(is_said("no camera saw the sole", record.foot.warnings));
    EXPECT_FALSE(is_said("the sole", record.warnings)) << "of one foot, with both";
  }
}

/// No camera sees the lower part of the inner walls, nor anything of them behind the arch; what is
/// told of these all the same has to be right.
TEST(SimulatedPair, HasItsBallGirthsThoughTheInnerWallsAreHidden) {
  SimulationSettings settings;
  settings.subject = Subject::kFeet;
  for (const std::uint64_t seed : {3U, 6U}) {
    settings.seed = seed;
    auto scan = scan_of(settings);
    ASSERT_TRUE(scan);
    const auto records = measure_capture(scan->capture, {}, {});
    ASSERT_TRUE(records) << records.error().line();
    ASSERT_EQ(records->size(), 2U);
    for (std::size_t foot = 0; foot < 2; ++foot) {
      const auto& measures = (*records)[foot].measures;
      const Measure* girth = measures.find("ball_girth");
      ASSERT_NE(girth, nullptr);
      ASSERT_TRUE(girth->u95_mm);
      const double error = girth->value_mm - scan->truth[foot].measures.at("ball_girth");
      EXPECT_LT(std::abs(error), 2.0) << seed << " " << foot;
      EXPECT_LT(std::abs(error), *girth->u95_mm) << seed << " " << foot;
      EXPECT_TRUE(is_said("the wall of the foot was not seen", girth->warnings));
      for (const char* id : {"toe1_angle", "ankle_girth", "heel_breadth"}) {
        const Measure* measure = measures.find(id);
        if (measure == nullptr) {
          EXPECT_TRUE(is_withheld(id, measures)) << id;
          continue;
        }
        ASSERT_TRUE(measure->u95()) << id;
        EXPECT_NEAR(measure->value(), scan->truth[foot].measures.at(id), *measure->u95()) << id;
      }
    }
  }
}

TEST(SimulatedPair, IsNoneForASingleFoot) {
  SimulationSettings settings;
  auto scan = scan_of(settings);
  ASSERT_TRUE(scan);
  const auto records = measure_capture(scan->capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  ASSERT_EQ(records->size(), 1U);
  EXPECT_FALSE(records->front().pair);
}

INSTANTIATE_TEST_SUITE_P(OfSomePeople, SimulatedFeet,
                         testing::Values(Person{2, Side::kLeft}, Person{5, Side::kRight},
                                         Person{7, Side::kRight}),
                         [](const auto& person) {
                           return "Seed" + std::to_string(person.param.seed);
                         });

}  // namespace
}  // namespace instep
