#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <utility>

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

using test::expect_true_measures;
using test::is_said;
using test::number_held;
using test::number_known;
using test::scan_of;

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

}  // namespace
}  // namespace instep
