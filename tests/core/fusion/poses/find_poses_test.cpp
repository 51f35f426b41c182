#include "core/fusion/poses/find_poses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/degree.h"
#include "tests/support/random_numbers.h"
#include "tests/support/ray_cast_scene.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// As large as a foot: a body with a stump on its rear end.
Surfaces object() {
  return {ellipsoid_surface({0, 0, 28}, {125, 45, 34}, 12),
          cylinder_surface({-60, -12}, 33, 30, 130)};
}

Surfaces on_a_platform(Surfaces scene) {
  scene.push_back(disc_surface({0, 0, 0}, {0, 0, 1}, 400));
  return scene;
}

std::vector<View> views_of(const Surfaces& scene, const std::vector<CameraGeometry>& cameras) {
  std::vector<View> views;
  for (const auto& camera : cameras) {
    TemporalFusion fusion;
    for (std::uint64_t i = 1; i <= 5; ++i) {
      EXPECT_TRUE(fusion.add(render(camera, scene, {1.4e-6, 0.7, 0.01}, 100 * views.size() + i)));
    }
    views.push_back({camera, *fusion.result(), nullptr});
  }
  return views;
}

const std::vector<CameraGeometry>& four_cameras() {
  static const auto cameras = ring_of_cameras(4, 450, 250, {0, 0, 20});
  return cameras;
}

const std::vector<View>& good_views() {
  static const auto views = views_of(on_a_platform(object()), four_cameras());
  return views;
}

/// Each camera is said to stand so far from where it does, and to look so far aside.
std::vector<View> ill_said(std::vector<View> views, double shift_mm, double turn_deg,
                           std::uint64_t seed) {
  test::RandomNumbers random(seed);
  const auto direction = [&random] {
    return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  };
  for (auto& view : views) {
    auto& pose = view.geometry.station_from_camera;
    pose.linear() = Eigen::AngleAxisd(turn_deg * kDegree, direction()) * pose.linear();
    pose.translation() += shift_mm * direction();
  }
  return views;
}

/// How far each view puts an object's places from where all together put them, root mean square:
/// the same motion of all is none. `depth_of_first`: what the first one's depths are multiplied by.
std::vector<double> apart(const FoundPoses& found, const std::vector<View>& truth,
                          double depth_of_first = 1.0) {
  std::vector<double> squares(truth.size(), 0.0);
  double places = 0.0;
  for (const double x : {-110.0, 110.0}) {
    for (const double y : {-40.0, 40.0}) {
      for (const double z : {0.0, 60.0}) {
        std::vector<Vector3d> put;
        Vector3d mean = Vector3d::Zero();
        for (std::size_t i = 0; i < truth.size(); ++i) {
          const Vector3d seen = truth[i].geometry.station_from_camera.inverse() * Vector3d(x, y, z);
          put.push_back(found.cameras[i].station_from_camera *
                        ((i == 0 ? depth_of_first : 1.0) * seen));
          mean += put.back() / static_cast<double>(truth.size());
        }
        for (std::size_t i = 0; i < put.size(); ++i) squares[i] += (put[i] - mean).squaredNorm();
        places += 1.0;
      }
    }
  }
  for (double& square : squares) square = std::sqrt(square / places);
  return squares;
}

TEST(FindPoses, FindsCamerasThatStandFarFromWhereTheyAreSaidTo) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto found = find_poses(ill_said(good_views(), 150.0, 25.0, seed));
    ASSERT_TRUE(found) << found.error().line();
    const auto off = apart(*found, good_views());
    for (std::size_t i = 0; i < off.size(); ++i) {
      EXPECT_LT(off[i], 0.5) << "seed " << seed << ", camera " << i;
      EXPECT_LE(off[i], *found->cameras[i].known_to_mm) << "seed " << seed << ", camera " << i;
      EXPECT_LT(*found->cameras[i].known_to_mm, 1.5);
      EXPECT_TRUE(found->cameras[i].is_level);
    }
  }
}

TEST(FindPoses, LaysThePlatformLevelAtItsHeight) {
  PoseFinding settings;
  settings.platform_height_mm = 40.0;
  const auto found = find_poses(ill_said(good_views(), 60.0, 10.0, 4), settings);
  ASSERT_TRUE(found) << found.error().line();
  for (std::size_t i = 0; i < found->cameras.size(); ++i) {
    const RigidTransform station_from_truth =
        found->cameras[i].station_from_camera *
        good_views()[i].geometry.station_from_camera.inverse();
    for (const double x : {-200.0, 0.0, 200.0}) {
      EXPECT_NEAR((station_from_truth * Vector3d(x, 0.5 * x, 0.0)).z(), 40.0, 0.3);
    }
  }
}

TEST(FindPoses, LeavesTheCamerasWhereTheyWereSaidToBeOnTheWhole) {
  // All are said to stand 30 mm further along and turned by 5 degrees about the platform's middle,
  // which nothing that they see contradicts.
  auto said = good_views();
  RigidTransform common = RigidTransform::Identity();
  common.linear() = Eigen::AngleAxisd(5.0 * kDegree, Vector3d::UnitZ()).toRotationMatrix();
  common.translation() = Vector3d(30.0, -12.0, 0.0);
  for (auto& view : said) {
    view.geometry.station_from_camera = common * view.geometry.station_from_camera;
  }
  const auto found = find_poses(said);
  ASSERT_TRUE(found) << found.error().line();
  for (const auto& camera : found->cameras) {
    EXPECT_LT(camera.moved_mm, 1.0);
    EXPECT_LT(camera.turned_deg, 0.2);
  }
}

TEST(FindPoses, SaysHowFarACameraStoodFromItsPlace) {
  auto said = good_views();
  said[2].geometry.station_from_camera.translation() += Vector3d(0.0, 40.0, 0.0);
  const auto found = find_poses(said);
  ASSERT_TRUE(found) << found.error().line();
  // A quarter of it is taken for the station's own place.
  EXPECT_NEAR(found->cameras[2].moved_mm, 30.0, 2.0);
  EXPECT_NEAR(found->cameras[0].moved_mm, 10.0, 2.0);
}

TEST(FindPoses, RefusesARoundObject) {
  const auto views = views_of(
      on_a_platform({rounded_puck({0, 0}, 60, 90, 5), cylinder_surface({0, 0}, 60, 5, 90)}),
      four_cameras());
  const auto found = find_poses(ill_said(views, 60.0, 10.0, 5));
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kInsufficientData);
  EXPECT_NE(found.error().message.find("round"), std::string::npos) << found.error().line();
}

TEST(FindPoses, RefusesAnEmptyPlatform) {
  const auto found = find_poses(views_of(on_a_platform({}), four_cameras()));
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("nothing that stands on the platform"), std::string::npos)
      << found.error().line();
}

TEST(FindPoses, RefusesTwoCamerasThatShareHardlyAnything) {
  // Low ones that face each other: they share the platform and hardly any skin.
  const auto cameras = ring_of_cameras(4, 450, 90, {0, 0, 20});
  const auto views = views_of(on_a_platform(object()), {cameras[1], cameras[3]});
  const auto found = find_poses(ill_said(views, 20.0, 4.0, 6));
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kInsufficientData);
  EXPECT_FALSE(found.error().advice.empty());
}

TEST(FindPoses, SaysOfACameraThatFitsNowhereWhatElseMayBeWrongWithIt) {
  auto views = std::vector<View>(good_views().begin(), good_views().begin() + 2);
  for (float& depth : views[0].depth.depth_mm) depth *= 1.1F;
  const auto found = find_poses(views);
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().advice.find("depth unit"), std::string::npos) << found.error().line();
}

TEST(FindPoses, LevelsASingleCameraAndMovesItNoFurther) {
  auto said = std::vector<View>{good_views()[0]};
  const RigidTransform truth = said[0].geometry.station_from_camera;
  RigidTransform tilted = RigidTransform::Identity();
  tilted.linear() = Eigen::AngleAxisd(8.0 * kDegree, Vector3d::UnitX()).toRotationMatrix();
  said[0].geometry.station_from_camera = tilted * truth;
  const auto found = find_poses(said);
  ASSERT_TRUE(found) << found.error().line();
  const RigidTransform off = found->cameras[0].station_from_camera * truth.inverse();
  EXPECT_GT(off.linear()(2, 2), std::cos(0.2 * kDegree));
  EXPECT_NEAR((off * Vector3d::Zero()).z(), 0.0, 0.3);
  EXPECT_FALSE(found->cameras[0].known_to_mm);
}

TEST(FindPoses, SaysWhichCameraDoesNotSeeThePlatform) {
  auto views = good_views();
  // As if it lay beyond this one's reach: what is left is the object.
  auto& depth = views[1].depth;
  const Deprojector rays = *Deprojector::create(views[1].geometry.intrinsics);
  for (std::size_t pixel = 0; pixel < depth.depth_mm.size(); ++pixel) {
    const Eigen::Vector3f own = rays.ray(pixel) * depth.depth_mm[pixel];
    if ((views[1].geometry.station_from_camera * own.cast<double>()).z() < 6.0) {
      depth.depth_mm[pixel] = depth.sigma_mm[pixel] = 0.0F;
    }
  }
  const auto found = find_poses(ill_said(views, 5.0, 0.5, 7));
  ASSERT_TRUE(found) << found.error().line();
  ASSERT_EQ(found->warnings.size(), 1U);
  EXPECT_NE(found->warnings[0].find("camera1 does not see the platform"), std::string::npos)
      << found->warnings[0];
  EXPECT_FALSE(found->cameras[1].is_level);
  for (const double off : apart(*found, good_views())) EXPECT_LT(off, 0.7);
}

TEST(FindPoses, RefusesWhereNoCameraSeesThePlatform) {
  const auto found = find_poses(views_of(object(), four_cameras()));
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("no camera sees the platform"), std::string::npos)
      << found.error().line();
  EXPECT_FALSE(find_poses({views_of(object(), four_cameras())[0]}));
}

TEST(FindPoses, TakesThePlatformAndNotTheLargerFloorAboutIt) {
  auto scene = object();
  scene.push_back(disc_surface({0, 0, 0}, {0, 0, 1}, 170));
  scene.push_back(disc_surface({0, 0, -150}, {0, 0, 1}, 900));
  const auto views = views_of(scene, four_cameras());
  const auto found = find_poses(ill_said(views, 20.0, 2.0, 9));
  ASSERT_TRUE(found) << found.error().line();
  EXPECT_TRUE(found->warnings.empty());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const RigidTransform off =
        found->cameras[i].station_from_camera * views[i].geometry.station_from_camera.inverse();
    EXPECT_NEAR((off * Vector3d::Zero()).z(), 0.0, 0.3);
  }
}

TEST(FindPoses, SaysThatThePlatformLiesFarFromWhereItWasSaidTo) {
  auto said = good_views();
  for (auto& view : said) view.geometry.station_from_camera.translation().z() += 60.0;
  const auto found = find_poses(said);
  ASSERT_TRUE(found) << found.error().line();
  ASSERT_EQ(found->warnings.size(), 1U);
  EXPECT_NE(found->warnings[0].find("60.0 mm lower"), std::string::npos) << found->warnings[0];
}

TEST(FindPoses, SaysThatTheObjectMovedBeforeACamera) {
  auto views = good_views();
  views[3].depth.moved = true;
  views[3].depth.movement_mm = 6.4;
  const auto found = find_poses(views);
  ASSERT_TRUE(found) << found.error().line();
  ASSERT_EQ(found->warnings.size(), 1U);
  EXPECT_NE(found->warnings[0].find("what camera camera3 sees moved by 6.4 mm"), std::string::npos)
      << found->warnings[0];
}

TEST(FindPoses, KnowsThatAWrongDepthLeavesMoreUnknown) {
  auto views = good_views();
  for (float& depth : views[0].depth.depth_mm) depth *= 1.01F;
  const auto found = find_poses(views);
  ASSERT_TRUE(found) << found.error().line();
  const auto off = apart(*found, good_views(), 1.01);
  for (std::size_t i = 0; i < off.size(); ++i) {
    EXPECT_LE(off[i], *found->cameras[i].known_to_mm) << "camera " << i;
  }
  EXPECT_FALSE(found->warnings.empty());
}

TEST(FindPoses, RefusesPosesThatAreNone) {
  auto views = good_views();
  views[1].geometry.station_from_camera.linear() *= 2.0;
  const auto found = find_poses(views);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(find_poses({}).error().code, ErrorCode::kInvalidInput);
}

TEST(FindPoses, EndsWhereItIsNoLongerWanted) {
  int pieces = 0;
  ASSERT_TRUE(find_poses(good_views(), {}, one_after_the_other, [&] { return ++pieces > 0; }));
  for (const int wanted : {0, 2, 5, 30, pieces - 5, pieces - 1}) {
    int asked = 0;
    const auto found =
        find_poses(good_views(), {}, one_after_the_other, [&] { return ++asked <= wanted; });
    ASSERT_FALSE(found) << wanted << " of " << pieces;
    EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
    EXPECT_LE(asked, wanted + 5);
  }
}

TEST(FindPoses, GivesTheSameBytesAgain) {
  const auto said = ill_said(good_views(), 60.0, 10.0, 8);
  const auto once = find_poses(said);
  const auto again = find_poses(said);
  ASSERT_TRUE(once && again);
  for (std::size_t i = 0; i < said.size(); ++i) {
    EXPECT_EQ(once->cameras[i].station_from_camera.matrix(),
              again->cameras[i].station_from_camera.matrix());
  }
}

}  // namespace
}  // namespace instep
