#include "core/geometry/piles/pile_shadow.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr PileLevel kLevel{1.0, 4.0, 16.0};
const PileFace kFace{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};

/// A square sheet with as many points as the level has.
std::vector<Eigen::Vector3d> sheet_at(double height) {
  std::vector<Eigen::Vector3d> points;
  for (double x = -9.0; x < 9.0; x += 0.5) {
    for (double y = -9.0; y < 9.0; y += 0.5) points.emplace_back(x, y, height);
  }
  return points;
}

std::size_t marked_of(const std::vector<Eigen::Vector3d>& points) {
  std::vector<bool> marked(points.size(), false);
  mark_shadows(points, {kFace}, kLevel, marked);
  return static_cast<std::size_t>(std::count(marked.begin(), marked.end(), true));
}

TEST(PileShadow, HoldsWhatStandsBeforeAndBehind) {
  for (const double height : {-7.0, -2.0, 2.0, 7.0}) {
    EXPECT_EQ(marked_of({{0.1, 0.2, height}}), 1U) << height;
    EXPECT_EQ(marked_of({{7.0, 0.2, height}}), 0U) << height;
  }
}

/// As many as a skin has, but in a heap.
TEST(PileShadow, HoldsStraysThatAreManyToo) {
  test::RandomNumbers random(1);
  std::vector<Eigen::Vector3d> strays;
  for (int i = 0; i < 4000; ++i) {
    strays.emplace_back(random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0),
                        random.uniform(2.0, 12.0));
  }
  EXPECT_GT(marked_of(strays), 1000U);
}

TEST(PileShadow, DoesNotHoldThePile) {
  EXPECT_EQ(marked_of({{0.1, 0.2, 0.5}, {0.3, 0.0, -0.9}}), 0U);
}

TEST(PileShadow, DoesNotHoldASkinThatFacesThePileNorWhatIsFarOff) {
  for (const double height : {2.0, 5.0, 12.0}) EXPECT_EQ(marked_of(sheet_at(height)), 0U);
  EXPECT_EQ(marked_of({{0.0, 0.0, 30.0}}), 0U);
}

TEST(PileShadow, LeavesMarksAsTheyAre) {
  const std::vector<Eigen::Vector3d> points = {{0.0, 0.0, 3.0}, {9.0, 0.0, 3.0}};
  std::vector<bool> marked = {true, true};
  mark_shadows(points, {kFace}, kLevel, marked);
  EXPECT_EQ(marked, std::vector<bool>({true, true}));
  marked = {false, false};
  mark_shadows(points, {}, kLevel, marked);
  EXPECT_EQ(marked, std::vector<bool>({false, false}));
}

}  // namespace
}  // namespace instep
