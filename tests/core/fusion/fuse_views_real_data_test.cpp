#include <gtest/gtest.h>

#include <filesystem>

#include "core/fusion/fuse_views.h"
#include "core/geometry/polygon.h"
#include "core/geometry/rectangle.h"
#include "tests/support/places.h"
#include "tests/support/recorded_frames.h"

namespace instep {
namespace {

/// One camera carried round two standing feet in 8 steps; one frame each, nominal poses.
TEST(FuseViewsOfARealCamera, GivesTwoCleanFeetThatAgree) {
  const auto folder = test::trial_data() / "d435-two-feet";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const auto recorded = read_recorded_frames(folder);
  std::vector<View> views;
  for (std::size_t i = 0; i < recorded.cameras.size(); ++i) {
    const auto depth = fuse_frames({recorded.frames[i]});
    ASSERT_TRUE(depth) << depth.error().line();
    views.push_back({recorded.cameras[i], *depth, nullptr});
  }
  FusionSettings settings;
  settings.refine_views = true;
  const auto scene = fuse_views(views, settings);
  ASSERT_TRUE(scene) << scene.error().line();

  EXPECT_EQ(scene->diagnostics.views_used, 8U);
  EXPECT_GT(scene->diagnostics.registration_before_mm, 5.0);
  EXPECT_LT(scene->diagnostics.registration_after_mm, 1.5);
  EXPECT_FALSE(scene->diagnostics.platform_found);
  ASSERT_EQ(scene->feet.size(), 2U);
  for (const auto& foot : scene->feet) {
    EXPECT_TRUE(check_cloud(foot));
    std::vector<Eigen::Vector2d> plan;
    for (const auto& point : foot.positions) plan.push_back(point.head<2>());
    const auto sides = enclosing_rectangle(convex_hull(plan));
    EXPECT_GT(sides.length, 235.0);
    EXPECT_LT(sides.length, 265.0);
    EXPECT_GT(sides.width, 80.0);
    EXPECT_LT(sides.width, 120.0);
  }
}

}  // namespace
}  // namespace instep
