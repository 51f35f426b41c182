#include "sim/simulated_station.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using namespace std::chrono_literals;

SimulationSettings small() {
  SimulationSettings settings;
  settings.width_px = 80;
  settings.height_px = 60;
  settings.pacing = Pacing::kAsFastAsPossible;
  return settings;
}

std::vector<DepthFrame> first_frames(SimulatedStation& station) {
  std::vector<DepthFrame> frames;
  for (const auto& camera : station.cameras) {
    EXPECT_TRUE(camera->start());
    frames.push_back(camera->next_frame(1s).value());
  }
  return frames;
}

TEST(SimulatedStation, HasFourCamerasRoundTheFoot) {
  auto station = build_station(small()).value();
  ASSERT_EQ(station.cameras.size(), 4U);
  std::vector<std::string> names;
  for (const auto& camera : station.cameras) {
    const CameraDescription& description = camera->description();
    names.push_back(description.geometry.id);
    EXPECT_TRUE(description.simulated);
    EXPECT_FALSE(description.serial.empty());
    const Eigen::Vector3d eye = description.geometry.station_from_camera.translation();
    EXPECT_NEAR((eye - Eigen::Vector3d(0, 0, 60)).norm(), 500.0, 1e-9);
    const double elevation = std::asin((eye.z() - 60) / 500) * 180 / std::numbers::pi;
    EXPECT_GE(elevation, 8.0);
    EXPECT_LE(elevation, 40.0);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"front", "left", "back", "right"}));
}

TEST(SimulatedStation, SameSettingsGiveTheSameBytes) {
  auto first = build_station(small()).value();
  auto second = build_station(small()).value();
  const auto frames = first_frames(first);
  const auto again = first_frames(second);
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].raw, again[i].raw);
  EXPECT_NE(frames[0].raw, frames[2].raw);
}

TEST(SimulatedStation, OtherSeedIsAnotherFoot) {
  SimulationSettings other = small();
  other.seed = 2;
  auto a = build_station(small()).value();
  auto b = build_station(other).value();
  EXPECT_GT((a.scene.solids[0].solid->bounds().sizes() - b.scene.solids[0].solid->bounds().sizes())
                .norm(),
            1.0);
}

TEST(SimulatedStation, TwoFeetStandApartWithTheirTruth) {
  SimulationSettings settings = small();
  settings.subject = Subject::kFeet;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    settings.seed = seed;
    settings.cameras = 1;
    const auto station = build_station(settings).value();
    ASSERT_EQ(station.scene.solids.size(), 2U);
    const auto& left = station.scene.solids[0];
    const auto& right = station.scene.solids[1];
    const RigidTransform left_from_right =
        left.station_from_solid.inverse() * right.station_from_solid;
    for (double x = 0; x < 300; x += 6) {
      for (double y = -70; y < 70; y += 6) {
        for (double z = 10; z < 300; z += 40) {
          const Eigen::Vector3d point(x, y, z);
          const bool in_both =
              right.solid->value(point) < 0 && left.solid->value(left_from_right * point) < 0;
          ASSERT_FALSE(in_both) << "seed " << seed << " at " << point.transpose();
        }
      }
    }
  }
  settings.seed = 1;
  const auto truth = build_station(settings).value().truth().value();
  ASSERT_EQ(truth.size(), 2U);
  EXPECT_EQ(truth[0].side, Side::kLeft);
  EXPECT_EQ(truth[1].side, Side::kRight);
  for (const auto& subject : truth) {
    for (const char* id : {"foot_length", "foot_breadth", "foot_breadth_horizontal", "ball_girth",
                           "waist_girth", "instep_girth"}) {
      EXPECT_GT(subject.measures.at(id), 70.0) << id;
    }
  }
}

TEST(SimulatedStation, KnowsTheGirthOfTheCylinder) {
  SimulationSettings settings = small();
  settings.subject = Subject::kCylinder;
  const auto truth = build_station(settings).value().truth().value();
  ASSERT_EQ(truth.size(), 1U);
  EXPECT_FALSE(truth[0].side);
  EXPECT_DOUBLE_EQ(truth[0].measures.at("girth"), 80.0 * std::numbers::pi);
}

TEST(SimulatedStation, FaultScriptReachesItsCamera) {
  SimulationSettings settings = small();
  settings.fault_script = "camera left: zero frame 1\n";
  auto station = build_station(settings).value();
  const auto frames = first_frames(station);
  const auto has_data = [](const DepthFrame& frame) {
    return std::any_of(frame.raw.begin(), frame.raw.end(), [](auto value) { return value > 0; });
  };
  EXPECT_TRUE(has_data(frames[0]));
  EXPECT_FALSE(has_data(frames[1]));
  EXPECT_TRUE(has_data(frames[2]));
}

TEST(SimulatedStation, RefusesWhatCannotBe) {
  const auto refused = [](auto change) {
    SimulationSettings settings = small();
    change(settings);
    const auto station = build_station(settings);
    EXPECT_FALSE(station);
    return station ? std::string() : station.error().line();
  };
  EXPECT_NE(refused([](auto& s) { s.cameras = 0; }), "");
  EXPECT_NE(refused([](auto& s) { s.cameras = 1000; }), "");
  EXPECT_NE(refused([](auto& s) { s.width_px = 100000; }), "");
  EXPECT_NE(refused([](auto& s) { s.fault_script = "camera top: never starts"; }).find("top"),
            std::string::npos);
  EXPECT_NE(refused([](auto& s) { s.fault_script = "\nrubbish"; }).find("line 2"),
            std::string::npos);
}

}  // namespace
}  // namespace instep
