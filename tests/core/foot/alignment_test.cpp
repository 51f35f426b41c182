#include "core/foot/alignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/foot/standing/shoe_last.h"
#include "tests/support/foot_body.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::FootBody;

RigidTransform turned(double angle, const Vector3d& axis, const Vector3d& shift) {
  RigidTransform transform = RigidTransform::Identity();
  transform.rotate(Eigen::AngleAxisd(angle, axis.normalized()));
  transform.pretranslate(shift);
  return transform;
}

double length(const FootScan& foot) {
  return foot.landmarks.at("acropodion").position_mm.x() -
         foot.landmarks.at("pternion").position_mm.x();
}

/// Extent of the body itself along the foot's axis: of a very dense cloud of it.
double true_extent(const FootScan& foot) {
  double least = 1e300;
  double most = -1e300;
  for (const auto& point : FootBody{260.0, 0.4}.points().positions) {
    const double x = (foot.foot_from_input * point).x();
    least = std::min(least, x);
    most = std::max(most, x);
  }
  return most - least;
}

PointCloud cylinder(const Vector3d& axis, double radius, double length_mm, int round = 90) {
  const Vector3d u = axis.unitOrthogonal();
  const Vector3d v = axis.cross(u);
  PointCloud cloud;
  for (double along = 0.0; along <= length_mm; along += 3.0) {
    for (int i = 0; i < round; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / round;
      cloud.positions.emplace_back(along * axis + radius * std::cos(angle) * u +
                                   radius * std::sin(angle) * v);
    }
  }
  return cloud;
}

PointCloud part_of(const PointCloud& cloud, bool (*keep)(const Vector3d&)) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (keep(cloud.positions[i])) indices.push_back(i);
  }
  return cloud.subset(indices);
}

TEST(Alignment, FindsHeelToesAndSide) {
  const auto foot = align_foot(FootBody{}.points());
  ASSERT_TRUE(foot) << foot.error().line();
  EXPECT_EQ(foot->side, Side::kRight);
  EXPECT_GT(foot->side_confidence, 0.9);
  EXPECT_NEAR(length(*foot), true_extent(*foot), 0.3);
  const Vector3d heel = foot->foot_from_input * Vector3d::Zero();
  EXPECT_LT(heel.head<2>().norm(), 3.0);
  EXPECT_LT(std::abs(foot->landmarks.at("toe2_tip").position_mm.y()), 0.1);
}

TEST(Alignment, GivesTheOtherSideForAMirroredFoot) {
  const auto right = align_foot(FootBody{}.points());
  const auto left = align_foot(test::mirrored(FootBody{}.points()));
  ASSERT_TRUE(right && left);
  EXPECT_EQ(left->side, Side::kLeft);
  EXPECT_NEAR(left->side_confidence, right->side_confidence, 1e-6);
  EXPECT_NEAR(length(*left), length(*right), 0.01);
}

TEST(Alignment, DoesNotDependOnWhereTheFootPoints) {
  const auto straight = align_foot(FootBody{}.points());
  ASSERT_TRUE(straight);
  for (const double angle : {0.4, 1.7, 3.1, 4.4}) {
    const auto moved =
        transformed(turned(angle, Vector3d::UnitZ(), {400, -300, 77}), FootBody{}.points());
    const auto foot = align_foot(moved);
    ASSERT_TRUE(foot) << foot.error().line();
    EXPECT_EQ(foot->side, Side::kRight);
    EXPECT_NEAR(length(*foot), length(*straight), 0.05);
  }
}

TEST(Alignment, FindsTheSoleWhenAnotherAxisPointsUp) {
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(1, 1, 0)}) {
    const auto tipped =
        transformed(turned(std::numbers::pi / 2, axis, {10, 20, 30}), FootBody{}.points());
    const auto foot = align_foot(tipped);
    ASSERT_TRUE(foot) << foot.error().line();
    EXPECT_EQ(foot->side, Side::kRight);
    EXPECT_NEAR(length(*foot), 260.0, 1.5);
  }
}

TEST(Alignment, TakesTheFloorThatTheStationKnows) {
  AlignmentOptions options;
  options.standing_plane = StandingPlane{Vector3d::UnitZ(), -2.0};
  const auto foot = align_foot(FootBody{}.points(), options);
  ASSERT_TRUE(foot);
  EXPECT_NEAR((foot->foot_from_input * Vector3d(100, 0, 0)).z(), 2.0, 1e-9);
}

TEST(Alignment, ObeysAForcedSide) {
  AlignmentOptions options;
  options.side = Side::kLeft;
  const auto foot = align_foot(FootBody{}.points(), options);
  ASSERT_TRUE(foot);
  EXPECT_EQ(foot->side, Side::kLeft);
  EXPECT_EQ(foot->side_confidence, 1.0);
}

TEST(Alignment, IsNotMovedByStrays) {
  auto cloud = FootBody{}.points();
  const auto clean = align_foot(cloud);
  cloud.positions.emplace_back(290.0, 10.0, 15.0);
  cloud.positions.emplace_back(-25.0, 5.0, 20.0);
  const auto foot = align_foot(cloud);
  ASSERT_TRUE(clean && foot);
  EXPECT_NEAR(length(*foot), length(*clean), 0.5);
}

// The foot was taken for a last, and its floor lay 10 mm too low.
TEST(Alignment, LeavesManyStraysOutAndSaysSo) {
  auto cloud = FootBody{}.points();
  const auto clean = align_foot(cloud);
  test::RandomNumbers random(3);
  const auto off = [&] { return random.uniform(-15.0, 15.0); };
  for (std::size_t i = 0; i < cloud.size(); i += 50) {
    cloud.positions[i] += Eigen::Vector3d(off(), off(), off());
  }
  const auto foot = align_foot(cloud);
  ASSERT_TRUE(clean && foot);
  EXPECT_NEAR(length(*foot), length(*clean), 0.5);
  const auto floor = [](const FootScan& aligned) {
    return (aligned.foot_from_input * Eigen::Vector3d(130.0, 0.0, 0.0)).z();
  };
  EXPECT_NEAR(floor(*foot), floor(*clean), 0.3);
  EXPECT_FALSE(is_shoe_last(*foot));
  const auto warns = [](const FootScan& aligned) {
    return std::any_of(aligned.warnings.begin(), aligned.warnings.end(), [](const auto& warning) {
      return warning.find("strays off the skin") != warning.npos;
    });
  };
  EXPECT_TRUE(warns(*foot));
  EXPECT_FALSE(warns(*clean));
}

// In line with the foot it looked like a leg, and most of the foot like what lies over its ankle.
TEST(Alignment, TakesNoBoxBeforeTheToesForALeg) {
  auto cloud = FootBody{}.points();
  const auto clean = align_foot(cloud);
  for (double x = 280.0; x <= 580.0; x += 4.0) {
    for (double across = -40.0; across <= 40.0; across += 4.0) {
      for (const double z : {0.0, 50.0}) cloud.positions.emplace_back(x, across, z);
    }
  }
  const auto foot = align_foot(cloud);
  ASSERT_TRUE(clean && foot);
  EXPECT_NEAR(length(*foot), length(*clean), 0.5);
}

TEST(Alignment, DropsRepeatedPoints) {
  auto cloud = FootBody{}.points();
  const auto once = align_foot(cloud);
  cloud.append(cloud);
  const auto twice = align_foot(cloud);
  ASSERT_TRUE(once && twice);
  EXPECT_EQ(twice->cloud.size(), once->cloud.size());
  EXPECT_EQ(length(*twice), length(*once));
}

TEST(Alignment, RefusesWhatIsNoFoot) {
  PointCloud table;
  for (int x = 0; x < 100; ++x) {
    for (int y = 0; y < 40; ++y) table.positions.emplace_back(2.6 * x, 2.6 * y, 0.0);
  }
  PointCloud one_point;
  one_point.positions.assign(1000, Vector3d(1, 2, 3));
  PointCloud line;
  for (int i = 0; i < 1000; ++i) line.positions.emplace_back(0.25 * i, 0.0, 0.0);
  for (const auto& cloud :
       {cylinder(Vector3d::UnitZ(), 40.0, 100.0), cylinder(Vector3d::UnitX(), 40.0, 250.0), table,
        one_point, line, PointCloud{}}) {
    const auto foot = align_foot(cloud);
    ASSERT_FALSE(foot);
    EXPECT_FALSE(foot.error().message.empty());
    EXPECT_FALSE(foot.error().advice.empty());
  }
}

TEST(Alignment, NamesTheLinesOfAScannerWhereItRefuses) {
  const auto foot = align_foot(cylinder(Vector3d::UnitX(), 40.0, 250.0, 360));
  ASSERT_FALSE(foot);
  EXPECT_NE(foot.error().advice.find("lines 3.0 mm apart"), std::string::npos)
      << foot.error().line();
}

TEST(Alignment, FindsTheSoleInAnyPose) {
  const auto body = FootBody{}.points();
  const auto straight = align_foot(body);
  ASSERT_TRUE(straight);
  for (const Vector3d& axis : {Vector3d(1, 2, 3), Vector3d(-2, 1, 0.3), Vector3d(0.2, -1, 2)}) {
    for (const double angle : {0.5, 1.4, 2.6, 3.1}) {
      const auto foot = align_foot(transformed(turned(angle, axis, {100, -50, 200}), body));
      ASSERT_TRUE(foot) << foot.error().line();
      EXPECT_EQ(foot->side, Side::kRight);
      EXPECT_NEAR(length(*foot), length(*straight), 0.5);
    }
  }
}

/// A rectangle of points, 4 mm apart.
void add_board(PointCloud& cloud, const Vector3d& corner, const Vector3d& u, const Vector3d& v) {
  const auto steps = [](const Vector3d& side) { return static_cast<int>(side.norm() / 4.0); };
  for (int i = 0; i <= steps(u); ++i) {
    for (int j = 0; j <= steps(v); ++j) {
      cloud.positions.push_back(corner + u * i / steps(u) + v * j / steps(v));
    }
  }
}

TEST(Alignment, RefusesRoomsTablesAndFusedFeet) {
  PointCloud room;
  add_board(room, {0, 0, 0}, {900, 0, 0}, {0, 900, 0});
  add_board(room, {0, 0, 0}, {900, 0, 0}, {0, 0, 700});
  add_board(room, {0, 0, 0}, {0, 900, 0}, {0, 0, 700});
  PointCloud table;
  add_board(table, {0, 0, 300}, {300, 0, 0}, {0, 110, 0});
  for (const double x : {0.0, 280.0}) add_board(table, {x, 0, 0}, {20, 0, 0}, {0, 0, 300});
  PointCloud fused = FootBody{}.points();
  for (const auto& point : test::mirrored(FootBody{}.points()).positions) {
    fused.positions.push_back(point - Vector3d(0.0, 92.0, 0.0));
  }
  for (const auto& cloud : {room, table, fused}) {
    const auto foot = align_foot(cloud);
    ASSERT_FALSE(foot);
    EXPECT_FALSE(foot.error().advice.empty());
  }
}

TEST(Alignment, RefusesHalfAFoot) {
  const auto whole = FootBody{}.points();
  EXPECT_FALSE(align_foot(part_of(whole, [](const Vector3d& p) { return p.x() < 130.0; })));
  EXPECT_FALSE(align_foot(part_of(whole, [](const Vector3d& p) { return p.x() > 120.0; })));
  EXPECT_FALSE(align_foot(part_of(whole, [](const Vector3d& p) { return p.y() > 0.0; })));
}

TEST(Alignment, RefusesFeetOfImpossibleSize) {
  EXPECT_FALSE(align_foot(FootBody{100.0, 1.0}.points()));
  EXPECT_FALSE(align_foot(FootBody{400.0, 3.0}.points()));
  EXPECT_TRUE(align_foot(FootBody{140.0, 1.0}.points()));
}

TEST(Alignment, RefusesNumbersThatAreNone) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e30}) {
    auto cloud = FootBody{}.points();
    cloud.positions[17].y() = bad;
    EXPECT_FALSE(align_foot(cloud));
  }
  AlignmentOptions options;
  options.up = Vector3d::Zero();
  EXPECT_FALSE(align_foot(FootBody{}.points(), options));
}

/// As where no camera saw the platform: the foot stands there, and its heights are doubtful.
TEST(AlignFoot, StandsOnAGuessedFloorThatItDoesNotTakeForKnown) {
  AlignmentOptions options;
  options.standing_plane = StandingPlane{Eigen::Vector3d::UnitZ(), 3.0};
  const auto known = align_foot(FootBody{}.points(), options);
  options.is_plane_guessed = true;
  const auto guessed = align_foot(FootBody{}.points(), options);
  ASSERT_TRUE(known && guessed);
  EXPECT_TRUE(known->is_floor_known);
  EXPECT_FALSE(guessed->is_floor_known);
  EXPECT_EQ(guessed->foot_from_input.matrix(), known->foot_from_input.matrix());
}

}  // namespace
}  // namespace instep
