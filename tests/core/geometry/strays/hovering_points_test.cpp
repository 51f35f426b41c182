#include "core/geometry/strays/hovering_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/point_spacing.h"
#include "core/geometry/strays/stray_points.h"
#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

std::vector<bool> hovering_of(const Points& points) {
  const PointIndex index(points);
  return hovering_points(index, usual_spacing(index, 200));
}

std::ptrdiff_t found_in(const Points& points) {
  const auto hovering = hovering_of(points);
  return std::count(hovering.begin(), hovering.end(), true);
}

Points joined(Points points, const Points& others) {
  points.insert(points.end(), others.begin(), others.end());
  return points;
}

Points dense_sphere(double sigma = 0.0) {
  return test::positions_of(test::sphere_points(1.0, 6000, sigma, 3));
}

/// Many stand no further from each other than from the skin, so that they do not stand alone.
TEST(HoveringPoints, AreStraysAmongStrays) {
  for (const double sigma : {0.0, 0.01}) {
    const Points skin = dense_sphere(sigma);
    Points strays;
    test::RandomNumbers random(5);
    for (int i = 0; i < 300; ++i) {
      const Vector3d way(random.normal(), random.normal(), random.normal());
      const double off = random.uniform(0.25, 0.6) * (i % 2 == 0 ? 1.0 : -1.0);
      strays.push_back((1.0 + off) * way.normalized());
    }
    const auto alone = stray_points(PointIndex(joined(skin, strays)), 0.05);
    EXPECT_LT(std::count(alone.begin(), alone.end(), true), 200);
    const auto hovering = hovering_of(joined(skin, strays));
    const auto of_strays = hovering.begin() + static_cast<std::ptrdiff_t>(skin.size());
    EXPECT_EQ(std::count(hovering.begin(), of_strays, true), 0) << sigma;
    EXPECT_GT(std::count(of_strays, hovering.end(), true), 285) << sigma;
  }
}

TEST(HoveringPoints, AreNoneOfSkinAlone) {
  EXPECT_EQ(found_in(dense_sphere()), 0);
  EXPECT_EQ(found_in(dense_sphere(0.05)), 0);
  // Four times as thick with noise as its points are apart: one in fifty.
  EXPECT_LT(found_in(dense_sphere(0.2)), 120);
}

/// Up to a sixth of the radius from each other.
TEST(HoveringPoints, AreNoneOfASparsePartOfASkin) {
  for (const std::size_t sparse : {1500U, 400U}) {
    Points points;
    for (const auto& point : dense_sphere()) {
      if (point.z() > 0.0) points.push_back(point);
    }
    for (const auto& point : test::sphere_points(1.0, sparse, 0.0, 4)) {
      if (point.position.z() <= 0.0) points.push_back(point.position);
    }
    EXPECT_EQ(found_in(points), 0) << sparse;
  }
}

/// Straight below the walls round it: of a face three times as sparse a twelfth was left out.
TEST(HoveringPoints, AreNoneOfASparseFaceOfABox) {
  Points points;
  std::size_t sparse = 0;
  test::RandomNumbers random(6);
  for (int i = 0; i < 20000; ++i) {
    const double along = random.uniform(-1.0, 1.0);
    const double up = random.uniform(-1.0, 1.0);
    const int wall = i % 4;
    if (wall == 3 && i % 9 != 0) continue;
    if (wall == 3) ++sparse;
    points.push_back(wall == 0   ? Vector3d(along, 1.0, up)
                     : wall == 1 ? Vector3d(1.0, along, up)
                     : wall == 2 ? Vector3d(-1.0, along, up)
                                 : Vector3d(along, -1.0, up));
  }
  EXPECT_LT(found_in(points), static_cast<std::ptrdiff_t>(sparse / 30));
}

TEST(HoveringPoints, AreNoneOfAFew) {
  EXPECT_EQ(hovering_points(PointIndex(Points{}), 1.0), std::vector<bool>{});
  EXPECT_EQ(hovering_points(PointIndex({{0, 0, 1}}), 1.0), std::vector<bool>{false});
  Points points(30, {0, 0, 1});
  points.emplace_back(0, 0, 40);
  EXPECT_EQ(hovering_points(PointIndex(points), 1.0).size(), points.size());
  EXPECT_EQ(found_in({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.2, 40}}), 0);
}

}  // namespace
}  // namespace instep
