#include "core/foot/skin/skin_round.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// A roof over a square 120 mm wide, 60 mm high in the middle, without what `is_missing`.
Points roof(int count, const std::function<bool(const Vector3d&)>& is_missing = {}) {
  test::RandomNumbers random(7);
  Points points;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-60.0, 60.0);
    const double y = random.uniform(-60.0, 60.0);
    const Vector3d point(x, y, 60.0 - (x * x + y * y) / 150.0);
    if (!is_missing || !is_missing(point)) points.push_back(point);
  }
  return points;
}

const Vector3d kTop(0.0, 0.0, 60.0);
const Vector3d kUp = Vector3d::UnitZ();

TEST(SkinRound, IsFoundOnSkinOfAnyDensity) {
  for (const int count : {400, 2000, 50000}) {
    EXPECT_TRUE(is_skin_all_round(roof(count), kTop, kUp)) << count;
    EXPECT_TRUE(is_skin_all_round(roof(count), {20.0, -15.0, 55.8}, kUp)) << count;
  }
}

TEST(SkinRound, IsNotAtARim) {
  for (const int count : {2000, 50000}) {
    for (const double turn : {0.0, 0.7, 2.0, 4.0}) {
      const Vector3d aside(std::cos(turn), std::sin(turn), 0.0);
      const auto cut = roof(count, [&](const Vector3d& point) { return aside.dot(point) > 0.0; });
      EXPECT_FALSE(is_skin_all_round(cut, kTop, kUp)) << count << " " << turn;
      EXPECT_TRUE(is_skin_all_round(cut, kTop - 25.0 * aside - 4.2 * kUp, kUp)) << turn;
    }
  }
}

TEST(SkinRound, IsInANarrowHoleAndNotInAWideOne) {
  const auto with_hole = [](double radius) {
    return roof(50000, [&](const Vector3d& point) { return point.head<2>().norm() < radius; });
  };
  EXPECT_TRUE(is_skin_all_round(with_hole(5.0), kTop, kUp));
  EXPECT_TRUE(is_skin_all_round(with_hole(5.0), {5.0, 0.0, 59.8}, kUp));
  EXPECT_FALSE(is_skin_all_round(with_hole(25.0), kTop, kUp));
  EXPECT_FALSE(is_skin_all_round(with_hole(25.0), {25.0, 0.0, 55.8}, kUp));
}

/// Below a wall that stands on the floor there is none.
TEST(SkinRound, EndsAtTheFloor) {
  test::RandomNumbers random(9);
  Points wall;
  for (int i = 0; i < 5000; ++i) {
    wall.emplace_back(random.uniform(-50.0, 50.0), 0.0, random.uniform(0.0, 50.0));
  }
  EXPECT_TRUE(is_skin_all_round(wall, {0.0, 0.0, 2.0}, Vector3d::UnitY()));
  auto cut = wall;
  std::erase_if(cut, [](const Vector3d& point) { return point.x() > 1.0; });
  EXPECT_FALSE(is_skin_all_round(cut, {0.0, 0.0, 2.0}, Vector3d::UnitY()));
  EXPECT_FALSE(is_skin_all_round(cut, {0.0, 0.0, 8.0}, Vector3d::UnitY()));
  for (auto& point : wall) point.z() += 30.0;
  EXPECT_FALSE(is_skin_all_round(wall, {0.0, 0.0, 32.0}, Vector3d::UnitY()));
}

/// Below a hole in a low toe's top lies its sole.
TEST(SkinRound, OfATopIsNotTheSoleBelow) {
  test::RandomNumbers random(11);
  Points sole;
  for (int i = 0; i < 5000; ++i) {
    sole.emplace_back(random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), 0.0);
  }
  EXPECT_FALSE(is_skin_all_round(sole, {0.0, 0.0, 15.0}, kUp));
}

TEST(SkinRound, IsNoneOfAFewPointsOrOfTheOtherSide) {
  EXPECT_FALSE(is_skin_all_round({}, kTop, kUp));
  EXPECT_FALSE(is_skin_all_round({{0, 0, 60}, {5, 0, 60}, {0, 5, 60}}, kTop, kUp));
  EXPECT_FALSE(is_skin_all_round(roof(2000), {0.0, 0.0, 100.0}, kUp));
}

}  // namespace
}  // namespace instep
