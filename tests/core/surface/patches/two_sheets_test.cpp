#include "core/surface/patches/two_sheets.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/degree.h"
#include "tests/support/bent_roof.h"
#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::BentRoof;

constexpr std::size_t kOnEach = 25;
constexpr std::uint64_t kSeeds = 40;

/// Of points of which the first `on_the_right` lie on one sheet, those that are parted otherwise.
std::ptrdiff_t on_the_wrong_side(const TwoSheets& sheets, std::size_t on_the_right) {
  const auto middle = sheets.sides.begin() + static_cast<std::ptrdiff_t>(on_the_right);
  const auto crossed =
      std::count(sheets.sides.begin(), middle, 0) + std::count(middle, sheets.sides.end(), 1);
  return std::min(crossed, static_cast<std::ptrdiff_t>(sheets.sides.size()) - crossed);
}

/// How many points of many roofs are put on the wrong sheet.
struct Wrong {
  std::ptrdiff_t by_planes = 0;
  std::ptrdiff_t by_quadratics = 0;
};

Wrong wrong_of(const BentRoof& roof) {
  Wrong wrong;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto points = roof.bare_points(kOnEach, kOnEach, seed);
    auto sheets = TwoSheets::by_planes(points);
    EXPECT_TRUE(sheets) << seed;
    if (!sheets) continue;
    EXPECT_TRUE(sheets->convex);
    wrong.by_planes += on_the_wrong_side(*sheets, kOnEach);
    sheets->part_by_quadratics(points, Vector3d::Zero(), 1.0);
    wrong.by_quadratics += on_the_wrong_side(*sheets, kOnEach);
  }
  return wrong;
}

TEST(TwoSheets, PlanesPartFlatSheets) {
  const auto wrong = wrong_of({60.0 * kDegree, 0.02, 0.02});
  EXPECT_EQ(wrong.by_planes, 0);
  EXPECT_EQ(wrong.by_quadratics, 0);
}

// Measured: 59, 12 and 42 of 2,000 points by planes, 1, 0 and 0 by quadratics.
TEST(TwoSheets, QuadraticsPartBentSheets) {
  for (const BentRoof& roof :
       {BentRoof{60.0 * kDegree, 0.9, 0.1}, BentRoof{60.0 * kDegree, 0.7, 0.7},
        BentRoof{90.0 * kDegree, 0.8, 0.2}}) {
    const auto wrong = wrong_of(roof);
    EXPECT_GT(wrong.by_planes, 8) << "too easy";
    EXPECT_LE(wrong.by_quadratics, 2);
  }
}

TEST(TwoSheets, ToldNormalsPartBentSheets) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto points = BentRoof{60.0 * kDegree, 0.9, 0.1}.points(kOnEach, kOnEach, seed);
    const auto sheets = TwoSheets::by_told_normals(points);
    ASSERT_TRUE(sheets) << seed;
    EXPECT_EQ(on_the_wrong_side(*sheets, kOnEach), 0) << seed;
  }
}

TEST(TwoSheets, PartsAreThePointsOfTheMembers) {
  const auto points = BentRoof{60.0 * kDegree, 0.7, 0.7}.bare_points(kOnEach, kOnEach, 1);
  const auto sheets = TwoSheets::by_planes(points);
  ASSERT_TRUE(sheets);
  const auto members = sheets->members();
  const auto parts = sheets->parted(points);
  EXPECT_EQ(members[0].size() + members[1].size(), points.size());
  for (const std::size_t side : {0U, 1U}) {
    ASSERT_EQ(parts[side].size(), members[side].size());
    for (std::size_t i = 0; i < parts[side].size(); ++i) {
      EXPECT_EQ(parts[side][i].position, points[members[side][i]].position);
    }
  }
}

/// Such as would take all points to one side, or tell no quadratic.
TEST(TwoSheets, QuadraticsLeaveSixOnEitherSheet) {
  test::RandomNumbers random(3);
  int parted = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const std::size_t on_the_left = 6 + seed % 5;
    auto points = BentRoof{70.0 * kDegree, 0.8, 0.1}.bare_points(12, on_the_left, seed);
    for (auto& point : points) {
      if (seed % 2 == 0) point.position.y() = 0.0;
      point.position.z() += random.uniform(-0.2, 0.2);
    }
    auto sheets = TwoSheets::by_planes(points);
    if (!sheets) continue;
    ++parted;
    sheets->part_by_quadratics(points, Vector3d::Zero(), 1.0);
    for (const auto& members : sheets->members()) EXPECT_GE(members.size(), 6U) << seed;
  }
  EXPECT_GT(parted, 50);
}

TEST(TwoSheets, AreNoneInASmoothBendOrOfFewPoints) {
  const BentRoof roof{70.0 * kDegree, 0.2, 0.2};
  EXPECT_TRUE(TwoSheets::by_planes(roof.bare_points(20, 8, 1)));
  EXPECT_FALSE(TwoSheets::by_planes(roof.bare_points(20, 4, 1)));
  EXPECT_FALSE(TwoSheets::by_planes(test::cap_points(3.0, 0.9, 60, 0.0, 1)));
  EXPECT_FALSE(TwoSheets::by_told_normals(roof.points(20, 4, 1)));
  EXPECT_FALSE(TwoSheets::by_planes({}));
  EXPECT_FALSE(TwoSheets::by_told_normals({}));
}

}  // namespace
}  // namespace instep
