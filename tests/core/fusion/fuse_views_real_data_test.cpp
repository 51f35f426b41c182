#include <gtest/gtest.h>

#include <filesystem>

#include "core/foot/align_feet.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "core/fusion/fuse_views.h"
#include "core/geometry/polygon.h"
#include "core/geometry/rectangle.h"
#include "tests/support/fused_frames.h"
#include "tests/support/places.h"
#include "tests/support/recorded_frames.h"

namespace instep {
namespace {

std::string why_withheld(const MeasureSet& set, const std::string& id) {
  for (const auto& one : set.withheld) {
    if (one.id == id) return one.reason;
  }
  return "";
}

/// One camera carried round two standing feet in 8 steps; one frame each, nominal poses.
class FuseViewsOfARealCamera : public testing::Test {
 protected:
  void SetUp() override {
    const auto folder = test::trial_data() / "d435-two-feet";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
    const auto recorded = read_recorded_frames(folder);
    std::vector<View> views;
    for (std::size_t i = 0; i < recorded.cameras.size(); ++i) {
      const auto depth = fuse_frames({recorded.frames[i]});
      ASSERT_TRUE(depth) << depth.error().line();
      views.push_back({recorded.cameras[i], *depth, nullptr});
    }
    auto fused = fuse_views(views);
    ASSERT_TRUE(fused) << fused.error().line();
    scene = *std::move(fused);
  }

  FusedScene scene;
};

TEST_F(FuseViewsOfARealCamera, GivesTwoCleanFeetThatAgree) {
  EXPECT_EQ(scene.diagnostics.views_used, 8U);
  EXPECT_GT(scene.diagnostics.registration_before_mm, 5.0);
  EXPECT_LT(scene.diagnostics.registration_after_mm, 1.5);
  EXPECT_FALSE(scene.diagnostics.platform_found);
  ASSERT_EQ(scene.feet.size(), 2U);
  for (const auto& foot : scene.feet) {
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

/// Where views disagree by millimetres, beside the ball above all, a doubled wall or the tail that
/// a view draws out at its silhouette leaves a section that does not close or that has spurs.
TEST_F(FuseViewsOfARealCamera, GivesEverySectionOfBothFeetAsOneSkinWithoutSpurs) {
  AlignmentOptions options;
  options.standing_plane = StandingPlane{Eigen::Vector3d::UnitZ(), scene.standing_height_mm};
  options.is_plane_guessed = !scene.is_standing_height_known;
  auto feet = align_feet(scene.feet, options);
  ASSERT_TRUE(feet) << feet.error().line();
  ASSERT_EQ(feet->size(), 2U);
  for (auto& aligned : *feet) {
    const auto foot = find_landmarks(std::move(aligned));
    ASSERT_TRUE(foot) << foot.error().line();
    const auto measured = measure_foot(*foot);
    ASSERT_TRUE(measured) << measured.error().line();
    for (const char* id : {"ball_girth", "waist_girth", "instep_girth"}) {
      const auto* measure = measured->find(id);
      ASSERT_NE(measure, nullptr) << id << ": " << why_withheld(*measured, id);
      // A foot has hardly a hollow there; a spur is walked up and down again.
      EXPECT_LT(measure->girth->contact_mm, 1.01 * measure->girth->stretched_mm) << id;
    }
    // The meshes that the origin made of these views are 246 mm and 252 mm long.
    const double truth = foot->side == Side::kLeft ? 246.0 : 252.0;
    EXPECT_NEAR(measured->find("foot_length")->value_mm, truth, 4.0);
  }
}

}  // namespace
}  // namespace instep
