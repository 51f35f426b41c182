#include "core/fusion/sole/close_sole.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "core/foot/measures/standing_girth.h"
#include "core/geometry/mesh_sampling.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/places.h"
#include "tests/support/shape_files.h"

namespace instep {
namespace {

constexpr std::size_t kPoints = 40000;
constexpr double kNoiseMm = 0.2;
constexpr double kLowestNormal = -0.5;  // z of what a camera beside the platform still sees

/// A scanned foot in its own frame, and the girths of its faces.
struct WholeFoot {
  TriangleMesh mesh;

  explicit WholeFoot(const char* name)
      : mesh(welded(test::read_shape(test::trial_data() / "feet" / name, 1000.0).mesh)) {
    const auto foot = align_foot(test::points_on(mesh, kPoints, 0.0, 1));
    if (!foot) throw std::runtime_error(foot.error().line());
    for (auto& corner : mesh.positions) corner = foot->foot_from_input * corner;
  }

  /// As a station without a camera under its platform sees it.
  PointCloud seen_from_beside(std::uint64_t seed) const {
    const auto all = test::oriented_points_on(mesh, kPoints, 0.0, seed);
    std::vector<std::size_t> seen;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all.normals[i].z() > kLowestNormal) seen.push_back(i);
    }
    auto cloud = test::with_noise(all.subset(seen), kNoiseMm, seed);
    cloud.normals.clear();
    return cloud;
  }

  /// As between two feet, where no camera sees the lower part of the inner wall.
  PointCloud seen_beside_another(double hidden_mm, double medial_sign, std::uint64_t seed) const {
    const auto cloud = seen_from_beside(seed);
    std::vector<std::size_t> seen;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto& point = cloud.positions[i];
      if (point.z() > hidden_mm || medial_sign * point.y() < 0.0) seen.push_back(i);
    }
    return cloud.subset(seen);
  }

  double girth(const TapePlane& plane) const {
    return standing_girth(girth_by_section(mesh, plane).value(), plane).stretched_mm;
  }
};

class CloseSoleOfRealFeet : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(test::trial_data() / "feet")) GTEST_SKIP() << "no trial data";
  }
};

/// Within the bar of a girth, where the tape runs round the edge of the sole and not over the arch:
/// there the scanner saw no more than a station does, and its own sole is a guess.
TEST_P(CloseSoleOfRealFeet, LeavesTheirGirthsWhatTheyAreWithTheirSoles) {
  constexpr double kBarMm = 1.0;
  const WholeFoot whole(GetParam());
  AlignmentOptions options;
  options.standing_plane = StandingPlane{};
  for (const std::uint64_t seed : {10U, 11U, 12U}) {
    const auto open = align_foot(whole.seen_from_beside(seed), options).and_then(find_landmarks);
    ASSERT_TRUE(open) << open.error().line();
    ASSERT_TRUE(open->cloud.stands_on_platform());
    const auto set = measure_foot(*open);
    ASSERT_TRUE(set) << set.error().line();
    const auto truth = [&](const TapePlane& plane) {
      return whole.girth(plane.transformed(open->foot_from_input.inverse()));
    };
    for (const char* id : {"ball_girth", "long_heel_girth"}) {
      const Measure* girth = set->find(id);
      ASSERT_NE(girth, nullptr) << id;
      EXPECT_NEAR(girth->value_mm, truth(*girth->plane), kBarMm) << id << " " << seed;
    }
    const double at = 0.15 * open->landmarks.at("acropodion").position_mm.x();
    const auto heel = TapePlane::through({at, 0, 0}, {at, 1, 0}, {at, 0, 1}).value();
    const auto girth = girth_by_rbf(open->cloud, heel);
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(standing_girth(*girth, heel).stretched_mm, truth(heel), kBarMm) << seed;
  }
}

TEST_P(CloseSoleOfRealFeet, LeavesTheirBallGirthsWithinTheirIntervalsWhereAWallWasHidden) {
  const WholeFoot whole(GetParam());
  AlignmentOptions options;
  options.standing_plane = StandingPlane{};
  const bool is_left = std::string(GetParam()) == "retail_left.stl";
  options.side = is_left ? Side::kLeft : Side::kRight;
  const double medial_sign = is_left ? -1.0 : 1.0;
  for (const double hidden_mm : {12.0, 18.0, 24.0}) {
    const auto open = align_foot(whole.seen_beside_another(hidden_mm, medial_sign, 10), options)
                          .and_then(find_landmarks);
    ASSERT_TRUE(open) << open.error().line();
    const auto set = measure_foot(*open);
    ASSERT_TRUE(set) << set.error().line();
    const Measure* girth = set->find("ball_girth");
    ASSERT_NE(girth, nullptr) << hidden_mm;
    ASSERT_TRUE(girth->u95_mm) << hidden_mm;
    const double truth = whole.girth(girth->plane->transformed(open->foot_from_input.inverse()));
    EXPECT_NEAR(girth->value_mm, truth, *girth->u95_mm) << hidden_mm;
    EXPECT_LT(*girth->u95_mm, 0.5 * hidden_mm) << hidden_mm;
  }
}

INSTANTIATE_TEST_SUITE_P(Retail, CloseSoleOfRealFeet,
                         testing::Values("retail_left.stl", "retail_right.stl"),
                         [](const auto& foot) {
                           return std::filesystem::path(foot.param).stem().string();
                         });

}  // namespace
}  // namespace instep
