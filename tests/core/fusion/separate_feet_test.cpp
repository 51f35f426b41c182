#include "core/fusion/separate_feet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace instep {
namespace {

using Eigen::Vector3d;

/// Upper half of a foot-like ellipsoid about (x, y), its heel-toe axis along x.
void add_foot(std::vector<Vector3d>& points, double x, double y, double length, double width,
              double height = 65) {
  for (double turn = 0; turn < 2 * std::numbers::pi; turn += 0.008) {
    for (double rise = 0.02; rise < 0.5 * std::numbers::pi; rise += 0.02) {
      points.emplace_back(x + 0.5 * length * std::cos(turn) * std::cos(rise),
                          y + 0.5 * width * std::sin(turn) * std::cos(rise),
                          height * std::sin(rise));
    }
  }
}

/// How many of the first `count` points and of the others a foot holds.
std::pair<std::size_t, std::size_t> shares(const std::vector<std::size_t>& foot,
                                           std::size_t count) {
  const auto split = std::lower_bound(foot.begin(), foot.end(), count);
  return {static_cast<std::size_t>(split - foot.begin()),
          static_cast<std::size_t>(foot.end() - split)};
}

TEST(SeparateFeet, TellsTwoFeetApartThatStandClose) {
  for (const double scale : {0.6, 1.0, 1.2}) {  // a child's and a large foot
    std::vector<Vector3d> points;
    add_foot(points, 0, 0, 255 * scale, 98 * scale);
    const std::size_t count = points.size();
    add_foot(points, 8, 98 * scale + 15, 250 * scale, 98 * scale);
    const auto separated = separate_feet(points, 0.0);
    ASSERT_EQ(separated.feet.size(), 2U) << scale;
    EXPECT_EQ(separated.strays, 0U);
    auto [a, b] = shares(separated.feet[0], count);
    EXPECT_TRUE(a == 0 || b == 0);
    EXPECT_EQ(separated.feet[0].size() + separated.feet[1].size(), points.size());
  }
}

TEST(SeparateFeet, SplitsTwoFeetThatTouch) {
  std::vector<Vector3d> points;
  add_foot(points, 0, 0, 255, 98);
  const std::size_t count = points.size();
  add_foot(points, 5, 98 - 1, 250, 98);
  const auto separated = separate_feet(points, 0.0);
  ASSERT_EQ(separated.feet.size(), 2U);
  for (const auto& foot : separated.feet) {
    const auto [a, b] = shares(foot, count);
    EXPECT_LT(static_cast<double>(std::min(a, b)), 0.02 * static_cast<double>(std::max(a, b)));
  }
}

/// Both together are no larger than one large foot, but too broad for one.
TEST(SeparateFeet, SplitsAChildsFeetThatTouch) {
  for (const double length : {150.0, 180.0, 210.0}) {
    const double width = 0.39 * length;
    std::vector<Vector3d> points;
    add_foot(points, 0, 0, length, width, 45);
    const std::size_t count = points.size();
    add_foot(points, 5, width - 1, length - 3, width, 45);
    const auto separated = separate_feet(points, 0.0);
    ASSERT_EQ(separated.feet.size(), 2U) << length;
    for (const auto& foot : separated.feet) {
      const auto [a, b] = shares(foot, count);
      EXPECT_LT(static_cast<double>(std::min(a, b)), 0.05 * static_cast<double>(std::max(a, b)));
    }
  }
}

TEST(SeparateFeet, DoesNotSplitAForefootAlone) {
  std::vector<Vector3d> whole;
  add_foot(whole, 0, 0, 260, 100);
  std::vector<Vector3d> front;
  for (const auto& point : whole) {
    if (point.x() > -10.0) front.push_back(point);
  }
  const auto separated = separate_feet(front, 0.0);
  ASSERT_EQ(separated.feet.size(), 1U);
  EXPECT_EQ(separated.feet[0].size(), front.size());
}

TEST(SeparateFeet, TakesOneFootForOneFootEvenInPieces) {
  std::vector<Vector3d> whole;
  add_foot(whole, 0, 0, 260, 100);
  EXPECT_EQ(separate_feet(whole, 0.0).feet.size(), 1U);
  // No camera saw the middle, nor the back of the instep.
  std::vector<Vector3d> pieces;
  for (const auto& point : whole) {
    if (std::abs(point.x() + 20) > 12 && std::abs(point.y()) > 8) pieces.push_back(point);
  }
  const auto separated = separate_feet(pieces, 0.0);
  ASSERT_EQ(separated.feet.size(), 1U);
  EXPECT_EQ(separated.feet[0].size(), pieces.size());
}

TEST(SeparateFeet, NamesAHeelThatNoCameraJoinsToTheFoot) {
  std::vector<Vector3d> whole;
  add_foot(whole, 0, 0, 260, 100);
  std::vector<Vector3d> parts;
  for (const auto& point : whole) {
    if (point.x() > 0.0 || point.x() < -70.0) parts.push_back(point);
  }
  const auto separated = separate_feet(parts, 0.0);
  ASSERT_EQ(separated.feet.size(), 1U);
  EXPECT_GT(separated.strays, 1000U);
  ASSERT_EQ(separated.warnings.size(), 1U);
  EXPECT_NE(separated.warnings[0].find("mm from foot 1 was left out"), std::string::npos)
      << separated.warnings[0];
  EXPECT_TRUE(separate_feet(whole, 0.0).warnings.empty());
}

/// A bag's corner, or the heel of a foot half out of view: as a foot it would spoil the other's
/// scan.
/// A baby's foot was "no foot: step on the platform".
TEST(SeparateFeet, SaysOfWhatIsTooShortToBeMeasuredHowLongItIs) {
  std::vector<Vector3d> points;
  add_foot(points, 0, 0, 112.5, 44, 28);
  const auto separated = separate_feet(points, 0.0);
  EXPECT_TRUE(separated.feet.empty());
  ASSERT_EQ(separated.warnings.size(), 1U);
  EXPECT_NE(separated.warnings[0].find("is 112 mm long"), std::string::npos)
      << separated.warnings[0];
  EXPECT_NE(separated.warnings[0].find("less than 120 mm"), std::string::npos);
  std::vector<Vector3d> crumb;
  add_foot(crumb, 0, 0, 20, 9, 5);
  EXPECT_TRUE(separate_feet(crumb, 0.0).warnings.empty());
  std::vector<Vector3d> hovering = points;
  for (auto& point : hovering) point.z() += 100.0;
  EXPECT_TRUE(separate_feet(hovering, 0.0).warnings.empty()) << "as a leg above a foot";
}

TEST(SeparateFeet, LeavesOutAndNamesWhatIsTooShortForAFoot) {
  std::vector<Vector3d> points;
  add_foot(points, 0, 0, 255, 98);
  const std::size_t count = points.size();
  add_foot(points, 0, 160, 105, 70);
  const auto separated = separate_feet(points, 0.0);
  ASSERT_EQ(separated.feet.size(), 1U);
  EXPECT_EQ(separated.feet[0].size(), count);
  ASSERT_EQ(separated.warnings.size(), 1U);
  EXPECT_NE(separated.warnings[0].find("too short for a foot"), std::string::npos)
      << separated.warnings[0];
}

TEST(SeparateFeet, DropsLegBackgroundAndFloor) {
  std::vector<Vector3d> points;
  add_foot(points, 0, 0, 255, 98);
  add_foot(points, 0, 130, 250, 98);
  const std::size_t count = points.size();
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 3000; ++i) {  // a shin without its foot, behind
    points.emplace_back(-300 + 30 * uniform(random), 50 + 30 * uniform(random),
                        110 + 30 * uniform(random));
  }
  for (int i = 0; i < 300; ++i) {  // a remnant of the floor
    points.emplace_back(200 + 15 * uniform(random), -80 + 15 * uniform(random), 1.0);
  }
  const auto separated = separate_feet(points, 0.0);
  ASSERT_EQ(separated.feet.size(), 2U);
  EXPECT_EQ(separated.strays, points.size() - count);
}

TEST(SeparateFeet, FindsNoneInWhatIsNone) {
  EXPECT_TRUE(separate_feet({}, 0.0).feet.empty());
  EXPECT_TRUE(separate_feet(std::vector<Vector3d>(1000, Vector3d(1, 2, 3)), 0.0).feet.empty());
  std::vector<Vector3d> shoebox_corner;
  for (int i = 0; i < 900; ++i) shoebox_corner.emplace_back(i % 30, 0.0, i / 30);
  EXPECT_TRUE(separate_feet(shoebox_corner, 0.0).feet.empty());
}

}  // namespace
}  // namespace instep
