#include "core/geometry/strays/strays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/geometry/point_spacing.h"
#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr std::size_t kOfSkin = 4000;

Points sphere() {
  return test::positions_of(test::sphere_points(1.0, kOfSkin, 0.0, 3));
}

/// As many at random, from half to one and a half of the radius, of which some lie near the skin.
Points with_strays(Points points, std::size_t count) {
  test::RandomNumbers random(17);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d way(random.normal(), random.normal(), random.normal());
    points.push_back(random.uniform(0.5, 1.5) * way.normalized());
  }
  return points;
}

std::vector<bool> strays_of(const Points& points, const StrayHunt& hunt = {}) {
  const PointIndex index(points);
  return strays_among(index, usual_spacing(index, points.size()), hunt);
}

/// Of the strays, those that were not found and lie further off the sphere than that.
std::size_t missed_beyond(double off, const Points& points, const std::vector<bool>& found) {
  std::size_t missed = 0;
  for (std::size_t i = kOfSkin; i < points.size(); ++i) {
    if (!found[i] && std::abs(points[i].norm() - 1.0) > off) ++missed;
  }
  return missed;
}

TEST(Strays, AreNotAmongThePointsOfASkin) {
  const auto found = strays_of(sphere());
  EXPECT_EQ(std::count(found.begin(), found.end(), true), 0);
}

TEST(Strays, AreFoundNearTheSkinWhereThereAreMany) {
  const Points points = with_strays(sphere(), 160);
  const auto found = strays_of(points);
  EXPECT_LE(missed_beyond(0.03, points, found), 2U);
  const auto lost = std::count(found.begin(), found.begin() + kOfSkin, true);
  EXPECT_LT(lost, 20) << "points of the skin beside strays";
}

TEST(Strays, OfFewAreLookedForNearTheSkinWhereThatIsAsked) {
  Points points = sphere();
  points.push_back(1.05 * points.front());
  EXPECT_EQ(missed_beyond(0.0, points, strays_of(points)), 1U);
  EXPECT_EQ(missed_beyond(0.0, points, strays_of(points, {.near_skin = true})), 0U);
  EXPECT_EQ(missed_beyond(0.0, points, strays_of(points, {.known_share = 0.02})), 0U);
}

}  // namespace
}  // namespace instep
