#include "core/fusion/fuse_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include "tests/support/ray_cast_scene.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Two feet 15 mm apart whose bottoms lie below the platform, shins on them, a platform.
Surfaces feet_alone() {
  return {ellipsoid_surface({0, 55, 28}, {125, 45, 34}, 3),
          ellipsoid_surface({4, -50, 28}, {120, 44, 33}, -3)};
}

Surfaces standing_person() {
  auto scene = feet_alone();
  scene.push_back(cylinder_surface({-55, 55}, 33, 30, 500));
  scene.push_back(cylinder_surface({-50, -50}, 33, 30, 500));
  scene.push_back(disc_surface({0, 0, 0}, {0, 0, 1}, 350));
  return scene;
}

std::vector<View> views_of(const Surfaces& scene, const std::vector<CameraGeometry>& cameras,
                           const RenderNoise& noise, int frames = 3) {
  std::vector<View> views;
  for (const auto& camera : cameras) {
    TemporalFusion fusion;
    for (int i = 0; i < frames; ++i) {
      EXPECT_TRUE(fusion.add(
          render(camera, scene, noise, views.size() * 100 + static_cast<std::size_t>(i) + 1)));
    }
    views.push_back({camera, *fusion.result(), nullptr});
  }
  return views;
}

const std::vector<View>& good_views() {
  static const std::vector<View> views =
      views_of(standing_person(), ring_of_cameras(4, 450, 330, {0, 0, 20}), {1.4e-6, 0.7, 0.01});
  return views;
}

FusionSettings at_zero() {
  FusionSettings settings;
  settings.platform_height_mm = 0.0;
  return settings;
}

double distance_to(const Surfaces& surfaces, const Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& surface : surfaces) least = std::min(least, std::abs(surface->distance(point)));
  return least;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const auto& line : lines) all += line + "\n";
  return all;
}

void expect_the_same(const Result<FusedScene>& one, const Result<FusedScene>& other) {
  ASSERT_TRUE(one && other);
  ASSERT_EQ(one->feet.size(), other->feet.size());
  for (std::size_t i = 0; i < one->feet.size(); ++i) {
    EXPECT_EQ(one->feet[i].positions, other->feet[i].positions);
    EXPECT_EQ(one->feet[i].sigma_mm, other->feet[i].sigma_mm);
  }
  EXPECT_EQ(one->warnings, other->warnings);
}

TEST(FuseViews, GivesTwoCleanFeetOnTheirSurfaces) {
  const auto scene = fuse_views(good_views(), at_zero());
  ASSERT_TRUE(scene) << scene.error().line();
  ASSERT_EQ(scene->feet.size(), 2U);
  EXPECT_NEAR(scene->standing_height_mm, 0.0, 0.1);
  EXPECT_TRUE(scene->diagnostics.platform_found);
  auto body = standing_person();
  body.pop_back();
  for (const auto& foot : scene->feet) {
    EXPECT_TRUE(check_cloud(foot));
    double z = 0;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < foot.size(); ++i) {
      if (!foot.was_seen(i)) continue;
      const double away = distance_to(body, foot.positions[i]);
      ASSERT_LT(away, 2.0) << foot.positions[i].transpose();
      z += std::pow(away / foot.sigma_mm[i], 2);
      ++seen;
    }
    EXPECT_GT(seen, 15000U);
    EXPECT_GT(std::sqrt(z / static_cast<double>(seen)), 0.65);
    EXPECT_LT(std::sqrt(z / static_cast<double>(seen)), 1.4);
  }
  for (const auto& own : scene->foot_warnings) {
    EXPECT_EQ(joined(own).find("not seen from all sides"), std::string::npos);
  }
}

TEST(FuseViews, ClosesTheSoleInsideTheFootOnly) {
  const auto scene = fuse_views(good_views(), at_zero());
  ASSERT_TRUE(scene);
  const auto feet = feet_alone();
  for (const auto& foot : scene->feet) {
    std::size_t closing = 0;
    for (std::size_t i = 0; i < foot.size(); ++i) {
      if (foot.was_seen(i)) continue;
      ++closing;
      const Vector3d& point = foot.positions[i];
      EXPECT_GE(point.z(), scene->standing_height_mm);
      const Vector3d at_widest(point.x(), point.y(), 28.0);
      EXPECT_LT(std::min(feet[0]->distance(at_widest), feet[1]->distance(at_widest)), 0.0);
    }
    EXPECT_GT(closing, 500U);
  }
  ASSERT_EQ(scene->foot_warnings.size(), 2U);
  for (const auto& own : scene->foot_warnings) {
    EXPECT_NE(joined(own).find("no camera saw the sole"), std::string::npos);
  }
}

TEST(FuseViews, LevelsATiltedStation) {
  RigidTransform tilt = RigidTransform::Identity();
  tilt.linear() = Eigen::AngleAxisd(0.03, Vector3d(1, 0.4, 0).normalized()).toRotationMatrix();
  tilt.translation() = Vector3d(3, -2, 25);
  auto views = good_views();
  for (auto& view : views) {
    view.geometry.station_from_camera = tilt * view.geometry.station_from_camera;
  }
  auto settings = at_zero();
  settings.platform_height_mm = 20.0;
  const auto scene = fuse_views(views, settings);
  ASSERT_TRUE(scene);
  EXPECT_NEAR(scene->diagnostics.platform_tilt_deg, 0.03 / 0.017453, 0.1);
  ASSERT_EQ(scene->feet.size(), 2U);
  double highest = 0;
  for (const auto& point : scene->feet[0].positions) {
    highest = std::max(highest, point.z() - scene->standing_height_mm);
    ASSERT_GT(point.z() - scene->standing_height_mm, -0.001);
  }
  EXPECT_LE(highest, 150.0);
}

/// Glass that gives no depth; what lies lowest of the feet is not on it.
TEST(FuseViews, TakesAGivenHeightThoughNoCameraSawThePlatform) {
  auto on_glass = standing_person();
  on_glass.pop_back();
  const auto views =
      views_of(on_glass, ring_of_cameras(4, 450, 330, {0, 0, 20}), {1.4e-6, 0.7, 0.01});
  const auto given = fuse_views(views, at_zero());
  ASSERT_TRUE(given) << given.error().line();
  EXPECT_FALSE(given->diagnostics.platform_found);
  EXPECT_TRUE(given->is_standing_height_known);
  EXPECT_EQ(given->standing_height_mm, 0.0);
  EXPECT_EQ(joined(given->warnings).find("no camera saw the platform"), std::string::npos);
  const auto guessed = fuse_views(views);
  ASSERT_TRUE(guessed) << guessed.error().line();
  EXPECT_FALSE(guessed->is_standing_height_known);
  EXPECT_GT(std::abs(guessed->standing_height_mm), 2.0);
  EXPECT_NE(joined(guessed->warnings).find("platform_height_mm"), std::string::npos);
}

TEST(FuseViews, RefinesNominalPoses) {
  auto views = good_views();
  const Vector3d shifts[] = {{8, 3, -4}, {-6, 5, 3}, {2, -7, 5}, {-3, -3, -6}};
  for (std::size_t i = 0; i < views.size(); ++i) {
    RigidTransform off = RigidTransform::Identity();
    off.linear() =
        Eigen::AngleAxisd(0.03, shifts[i].cross(Vector3d::UnitX()).normalized()).toRotationMatrix();
    off.translation() = shifts[i];
    views[i].geometry.station_from_camera = off * views[i].geometry.station_from_camera;
  }
  const auto scene = fuse_views(views, at_zero());
  ASSERT_TRUE(scene) << scene.error().line();
  EXPECT_EQ(scene->feet.size(), 2U);
  EXPECT_EQ(scene->diagnostics.views_used, 4U);
  EXPECT_LT(scene->diagnostics.registration_after_mm, 0.5);
  EXPECT_GT(scene->diagnostics.registration_before_mm, 2.0);
}

std::string warnings_of(const std::vector<View>& views, bool refine) {
  auto settings = at_zero();
  settings.refine_views = refine;
  const auto scene = fuse_views(views, settings);
  EXPECT_TRUE(scene) << scene.error().line();
  return scene ? joined(scene->warnings) : "";
}

TEST(FuseViews, SaysThatPosesAreWrong) {
  auto views = good_views();
  for (const bool refine : {false, true}) {
    EXPECT_EQ(warnings_of(views, refine).find("given poses"), std::string::npos);
    EXPECT_EQ(warnings_of({views[0]}, refine).find("pose"), std::string::npos);
  }
  views[1].geometry.station_from_camera.translation() += Vector3d(0.15, 0.35, 0.0);
  EXPECT_NE(warnings_of(views, false).find("camera1 before others"), std::string::npos);
  EXPECT_EQ(warnings_of(views, true).find("given poses"), std::string::npos);
  views[1].geometry.station_from_camera.translation() += Vector3d(0.0, 10.0, 0.0);
  EXPECT_NE(warnings_of(views, true).find("they were refined"), std::string::npos);
}

TEST(FuseViews, NamesTheCameraWhoseLensIsOff) {
  EXPECT_EQ(warnings_of(good_views(), true).find("of its size"), std::string::npos);
  auto views = good_views();
  views[2].geometry.intrinsics.fx *= 1.01;
  views[2].geometry.intrinsics.fy *= 1.01;
  EXPECT_NE(warnings_of(views, true).find("what camera camera2 sees"), std::string::npos)
      << warnings_of(views, true);
}

TEST(FuseViews, TellsTheErrorsThatAreLeftOfPosesAndLenses) {
  const auto refined = fuse_views(good_views(), at_zero());
  ASSERT_TRUE(refined);
  for (const auto& foot : refined->feet) {
    EXPECT_TRUE(foot.is_consistent());
    EXPECT_GE(foot.shared_errors_mm.size(), 2U);
    EXPECT_LE(foot.shared_errors_mm.size(), 20U);  // of 32
  }
  auto trusting = at_zero();
  trusting.refine_views = false;
  const auto trusted = fuse_views(good_views(), trusting);
  ASSERT_TRUE(trusted);
  for (const auto& foot : trusted->feet) EXPECT_TRUE(foot.shared_errors_mm.empty());
}

/// Two cameras on opposite sides see one platform, and no skin that both see.
TEST(FuseViews, SaysThatAViewCouldSlide) {
  const std::vector<View> opposite = {good_views()[0], good_views()[2]};
  for (const bool refine : {false, true}) {
    EXPECT_NE(warnings_of(opposite, refine).find("could slide along"), std::string::npos);
    EXPECT_EQ(warnings_of(good_views(), refine).find("could slide along"), std::string::npos);
  }
}

TEST(FuseViews, SaysWhatNoPoseExplains) {
  EXPECT_EQ(warnings_of(good_views(), true).find("calibrate their depths"), std::string::npos);
  auto views = good_views();
  auto& depth = views[1].depth;
  for (int y = 0; y < depth.height; ++y) {  // bent, as by a wrong lens
    for (int x = 0; x < depth.width; ++x) {
      auto& millimetres = depth.depth_mm[static_cast<std::size_t>(y * depth.width + x)];
      if (millimetres > 0.0F) millimetres += static_cast<float>(5.0 * std::sin(0.04 * x));
    }
  }
  EXPECT_NE(warnings_of(views, true).find("calibrate their depths"), std::string::npos);
}

TEST(FuseViews, NamesACameraThatSawNothing) {
  auto views = good_views();
  views[2].depth.depth_mm.assign(views[2].depth.depth_mm.size(), 0.0F);
  const auto scene = fuse_views(views, at_zero());
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->diagnostics.views_used, 3U);
  EXPECT_NE(joined(scene->warnings).find("camera2"), std::string::npos);
}

TEST(FuseViews, WorksWithOneCameraAndSaysWhatItMissed) {
  const auto scene = fuse_views({good_views()[0]}, at_zero());
  ASSERT_TRUE(scene) << scene.error().line();
  EXPECT_GE(scene->feet.size(), 1U);
  ASSERT_EQ(scene->foot_warnings.size(), scene->feet.size());
  EXPECT_NE(joined(scene->foot_warnings[0]).find("not seen from all sides"), std::string::npos);
}

TEST(FuseViews, TellsTheOperatorWhenNobodyStandsThere) {
  const auto empty = views_of({disc_surface({0, 0, 0}, {0, 0, 1}, 350)},
                              ring_of_cameras(2, 450, 330, {0, 0, 20}), {1.4e-6, 0.7, 0.01});
  const auto scene = fuse_views(empty, at_zero());
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, ErrorCode::kInsufficientData);
  EXPECT_NE(scene.error().advice.find("step on the platform"), std::string::npos);
  EXPECT_EQ(scene.error().advice.find("noticed"), std::string::npos) << "what would it be?";
}

/// A ball too small to be a foot; it may be one that the cameras see in wrong places.
TEST(FuseViews, TellsWhatWasNoticedBeforeWhatIsNoFoot) {
  const Surfaces ball = {ellipsoid_surface({0, 0, 20}, {20, 20, 20}, 0),
                         disc_surface({0, 0, 0}, {0, 0, 1}, 350)};
  auto views = views_of(ball, ring_of_cameras(4, 450, 330, {0, 0, 20}), {1.4e-6, 0.7, 0.01});
  views[1].geometry.station_from_camera.translation() += Vector3d(0.0, 0.0, 0.5);
  auto settings = at_zero();
  settings.refine_views = false;
  const auto scene = fuse_views(views, settings);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message, "no foot stands on the platform");
  EXPECT_NE(scene.error().advice.find("let them be refined"), std::string::npos)
      << scene.error().line();
}

TEST(FuseViews, TellsTheOperatorWhenAllCamerasAreBlind) {
  auto views = good_views();
  for (auto& view : views) view.depth.depth_mm.assign(view.depth.depth_mm.size(), 0.0F);
  const auto scene = fuse_views(views, at_zero());
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, ErrorCode::kInsufficientData);
  EXPECT_NE(scene.error().advice.find("cover"), std::string::npos);
  EXPECT_EQ(fuse_views({}, at_zero()).error().code, ErrorCode::kInvalidInput);
}

TEST(FuseViews, RefusesPosesLensesAndSizesThatAreNotSound) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](auto change) {
    auto views = std::vector<View>(good_views().begin(), good_views().begin() + 1);
    change(views[0]);
    return fuse_views(views, at_zero());
  };
  const auto bad_pose =
      with([&](View& v) { v.geometry.station_from_camera.translation().x() = nan; });
  ASSERT_FALSE(bad_pose);
  EXPECT_EQ(bad_pose.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(bad_pose.error().message.find("camera0"), std::string::npos);
  EXPECT_FALSE(with([](View& v) { v.geometry.station_from_camera.linear() *= 2.0; }));
  EXPECT_FALSE(with([](View& v) { v.geometry.station_from_camera.translation().x() = 1e30; }));
  EXPECT_FALSE(with([&](View& v) { v.geometry.intrinsics.fx = nan; }));
  EXPECT_EQ(with([](View& v) { v.depth.depth_mm.pop_back(); }).error().code,
            ErrorCode::kCorruptData);
  EXPECT_FALSE(with([](View& v) { v.depth.width = 320; }));
}

TEST(FuseViews, BearsDepthThatIsAbsurd) {
  for (const float depth : {65535.0F, 1e30F, std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN(), -500.0F, 1e-30F}) {
    auto views = good_views();
    for (auto& view : views) view.depth.depth_mm.assign(view.depth.depth_mm.size(), depth);
    EXPECT_FALSE(fuse_views(views, at_zero())) << depth;
    auto trusting = at_zero();
    trusting.refine_views = false;
    EXPECT_FALSE(fuse_views(views, trusting)) << depth;
  }
  auto views = good_views();
  for (std::size_t i = 0; i < views[1].depth.depth_mm.size(); i += 3) {
    views[1].depth.depth_mm[i] = std::numeric_limits<float>::quiet_NaN();
    views[1].depth.sigma_mm[i + 1] = std::numeric_limits<float>::quiet_NaN();
  }
  const auto scene = fuse_views(views, at_zero());
  ASSERT_TRUE(scene);
  for (const auto& foot : scene->feet) EXPECT_TRUE(check_cloud(foot));
}

TEST(FuseViews, IsTheSameEveryTime) {
  expect_the_same(fuse_views(good_views(), at_zero()), fuse_views(good_views(), at_zero()));
}

TEST(FuseViews, IsTheSameWhicheverCameraComesFirst) {
  auto turned = good_views();
  std::rotate(turned.begin(), turned.begin() + 1, turned.end());
  std::swap(turned[0], turned[1]);
  expect_the_same(fuse_views(good_views(), at_zero()), fuse_views(turned, at_zero()));
}

TEST(FuseViews, IsTheSameWithAThreadForEachView) {
  const Workers threads = [](std::size_t count, const std::function<void(std::size_t)>& work) {
    std::vector<std::thread> running;
    for (std::size_t job = count; job-- > 0;) running.emplace_back([&work, job] { work(job); });
    for (auto& thread : running) thread.join();
  };
  const auto alone = fuse_views(good_views(), at_zero());
  const auto together = fuse_views(good_views(), at_zero(), threads);
  expect_the_same(alone, together);
}

TEST(FuseViews, GivesUpWhenToldSoAfterAnyPiece) {
  std::size_t pieces = 0;
  const auto whole = fuse_views(good_views(), at_zero(), one_after_the_other, [&] {
    ++pieces;
    return true;
  });
  ASSERT_TRUE(whole);
  EXPECT_GE(pieces, 2 * good_views().size() + whole->feet.size());
  for (std::size_t k = 1; k <= pieces; ++k) {
    std::size_t asked = 0;
    const auto cut =
        fuse_views(good_views(), at_zero(), one_after_the_other, [&] { return ++asked < k; });
    ASSERT_FALSE(cut) << k;
    EXPECT_EQ(cut.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(asked, k) << "it went on after the cancel";
  }
}

}  // namespace
}  // namespace instep
