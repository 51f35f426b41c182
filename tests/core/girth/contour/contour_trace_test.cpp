#include "core/girth/contour/contour_trace.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.5;

BlendedSurface surface_of(const OrientedPoints& points) {
  return BlendedSurface(
      PatchFitter(points, PointIndex(test::positions_of(points)), {{Vector3d::Zero(), 0.01}}));
}

std::optional<Contour> trace(BlendedSurface& surface, const Vector2d& start) {
  return trace_contour(surface, start, 0.02, 0.2, 10.0);
}

double polygon_length(const std::vector<Vector2d>& corners) {
  double length = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    length += (corners[(i + 1) % corners.size()] - corners[i]).norm();
  }
  return length;
}

double area_of(const std::vector<Vector2d>& corners) {
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& a = corners[i];
    const Vector2d& b = corners[(i + 1) % corners.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

TEST(ContourTrace, MeetsTheLengthOfACircleFromFinePoints) {
  for (const std::size_t count : {20000U, 40000U}) {
    auto surface = surface_of(test::sphere_points(kRadius, count, 0.0, 1));
    const auto contour = trace(surface, {kRadius, 0.0});
    ASSERT_TRUE(contour);
    const double length = 2.0 * kPi * kRadius;
    EXPECT_NEAR(contour->length(), length, 1e-6 * length) << count;
  }
}

TEST(ContourTrace, CornersLieOnTheZeroLineInOrderAndFaceOutwards) {
  auto surface = surface_of(test::sphere_points(kRadius, 4000, 0.002, 2));
  // Patches added on the way change the field a little; on the second way round there are none.
  ASSERT_TRUE(trace(surface, {kRadius, 0.0}));
  const auto patches = surface.patches();
  const auto contour = trace(surface, {kRadius, 0.0});
  ASSERT_TRUE(contour);
  ASSERT_EQ(surface.patches(), patches);
  ASSERT_EQ(contour->points.size(), contour->outward.size());
  EXPECT_NEAR(area_of(contour->points), kPi * kRadius * kRadius, 0.01) << "counter-clockwise";
  for (std::size_t i = 0; i < contour->points.size(); ++i) {
    const Vector2d& corner = contour->points[i];
    const auto field = surface.at({corner.x(), corner.y(), 0.0});
    ASSERT_TRUE(field);
    EXPECT_NEAR(field->value, 0.0, 1e-9);
    EXPECT_NEAR(contour->outward[i].norm(), 1.0, 1e-9);
    EXPECT_GT(contour->outward[i].dot(corner.normalized()), 0.95);
    EXPECT_GT(contour->outward[i].dot(field->gradient.head<2>().normalized()), 1.0 - 1e-6);
    const Vector2d& next = contour->points[(i + 1) % contour->points.size()];
    EXPECT_LE((next - corner).norm(), 0.02 * 1.5) << "a step is at most 0.02";
    EXPECT_GT(corner.x() * next.y() - corner.y() * next.x(), 0.0) << "a step back";
  }
}

TEST(ContourTrace, DoesNotDependOnWhereItStarts) {
  const auto points = test::sphere_points(kRadius, 4000, 0.0, 3);
  for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
    for (const double off : {0.98, 1.0, 1.02}) {
      auto surface = surface_of(points);
      const auto contour =
          trace(surface, off * kRadius * Vector2d(std::cos(angle), std::sin(angle)));
      ASSERT_TRUE(contour) << angle << " " << off;
      EXPECT_NEAR(contour->length(), 2.0 * kPi * kRadius, 1e-4);
    }
  }
}

/// Patches that are added on the way move the line from under its first corner: it comes back
/// beside it, in a bend past the end of one step and before the beginning of the next.
TEST(ContourTrace, GoesRoundOnceWhereverItStarts) {
  constexpr double kSmallRadius = 0.12;
  const auto points = test::sphere_points(kSmallRadius, 600, 0.006, 9);
  for (int start = 0; start < 1000; ++start) {
    auto surface = surface_of(points);
    const double angle = 2.0 * kPi * start / 1000;
    const auto contour = trace(surface, kSmallRadius * Vector2d(std::cos(angle), std::sin(angle)));
    ASSERT_TRUE(contour) << start;
    EXPECT_LT(area_of(contour->points), 1.5 * kPi * kSmallRadius * kSmallRadius) << start;
  }
}

TEST(ContourTrace, MeetsThePerimeterOfASquarePrism) {
  for (const double sigma : {0.0, 0.001}) {
    auto surface = surface_of(test::prism_points(1.0, 0.4, 0.02, sigma, 4));
    const auto contour = trace(surface, {0.5, 0.1});
    ASSERT_TRUE(contour) << sigma;
    // Edges rounded off within a spacing would make it 0.034 shorter.
    EXPECT_NEAR(contour->length(), 4.0, sigma == 0.0 ? 2e-3 : 1e-2) << sigma;
    EXPECT_NEAR(area_of(contour->points), 1.0, 5e-3) << sigma;
  }
}

/// A corner of the line where the body is hollow by a right angle, of patches that go on straight
/// behind it: the line leaves it just in the direction that pointed outwards before.
TEST(ContourTrace, TurnsRoundTheCornersOfAGroove) {
  // Random places on the sides of a square of 1 that a square of 0.4 is cut out of.
  const std::vector<Vector2d> corners = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5},  {0.2, 0.5},
                                         {0.2, 0.1},   {-0.2, 0.1}, {-0.2, 0.5}, {-0.5, 0.5}};
  const double length = polygon_length(corners);
  int closed = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    test::RandomNumbers random(seed);
    OrientedPoints points;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector2d& from = corners[i];
      const Vector2d along = corners[(i + 1) % corners.size()] - from;
      const Vector3d outward(along.y(), -along.x(), 0.0);
      const int count = static_cast<int>(3000.0 * along.norm());
      for (int k = 0; k < count; ++k) {
        const Vector2d place = from + random.uniform(0.0, 1.0) * along;
        points.push_back(
            {{place.x(), place.y(), random.uniform(-0.2, 0.2)}, outward.normalized(), 1e-6});
      }
    }
    for (const double turn : {0.0, 0.3, 0.7, 1.1}) {
      auto turned = points;
      const Eigen::Rotation2Dd rotation(turn);
      for (auto& point : turned) {
        point.position.head<2>() = (rotation * point.position.head<2>()).eval();
        point.normal.head<2>() = (rotation * point.normal.head<2>()).eval();
      }
      auto surface = surface_of(turned);
      const auto contour = trace(surface, rotation * Vector2d(-0.5, 0.1));
      if (!contour) continue;
      ++closed;
      EXPECT_NEAR(contour->length(), length, 0.02);
    }
  }
  EXPECT_EQ(closed, 16);
}

TEST(ContourTrace, SpansAHoleWithinReachOnly) {
  OrientedPoints rim;
  for (const auto& point : test::sphere_points(kRadius, 6000, 0.0, 5)) {
    if (std::acos(point.normal.x()) > 0.2) rim.push_back(point);
  }
  auto surface = surface_of(rim);
  const auto contour = trace_contour(surface, {-kRadius, 0.0}, 0.02, 0.2, 10.0);
  ASSERT_TRUE(contour);
  EXPECT_NEAR(contour->length(), 2.0 * kPi * kRadius, 2e-3);
  auto again = surface_of(rim);
  EXPECT_FALSE(trace_contour(again, {-kRadius, 0.0}, 0.02, 0.05, 10.0)) << "the hole is 0.1 deep";
}

TEST(ContourTrace, FindsNothingWhereThereIsNoLoop) {
  auto sheet =
      surface_of(test::disc_points(Vector3d::Zero(), Vector3d::UnitX(), 0.5, 2000, 0.0, 6));
  EXPECT_FALSE(trace(sheet, {0.0, 0.0})) << "a sheet has an end";
  auto above = test::sphere_points(0.3, 2000, 0.0, 7);
  for (auto& point : above) point.position.z() += 0.6;
  auto ball = surface_of(above);
  EXPECT_FALSE(trace(ball, {0.3, 0.0})) << "the body is above the plane";
  auto sphere = surface_of(test::sphere_points(kRadius, 2000, 0.0, 8));
  EXPECT_FALSE(trace(sphere, {30.0, 0.0})) << "far from the body";
  EXPECT_FALSE(trace_contour(sphere, {kRadius, 0.0}, 0.02, 0.2, 2.0)) << "longer than allowed";
}

/// Random points make no surface; whatever is found must keep its bounds.
TEST(ContourTrace, KeepsItsBoundsOnRandomPoints) {
  int traced = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    test::RandomNumbers random(seed);
    const auto any = [&] {
      return Vector3d(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                      random.uniform(-0.5, 0.5));
    };
    OrientedPoints cloud;
    for (int i = 0; i < 2000; ++i) cloud.push_back({any(), any().normalized(), 1e-6});
    auto surface = surface_of(cloud);
    for (int start = 0; start < 5; ++start) {
      const auto contour = trace(surface, any().head<2>());
      if (!contour) continue;
      ++traced;
      EXPECT_LT(polygon_length(contour->points), 10.1);
      for (const auto& corner : contour->points) {
        EXPECT_LT(surface.distance_to_data({corner.x(), corner.y(), 0.0}), 0.2 + 1e-9);
      }
    }
  }
  EXPECT_GT(traced, 0);
}

Vector2d at_angle(double degrees) {
  const double angle = degrees * kPi / 180.0;
  return kRadius * Vector2d(std::cos(angle), std::sin(angle));
}

TEST(ContourTrace, FollowsALineThatDoesNotCloseFromEndToEnd) {
  auto points = test::sphere_points(kRadius, 8000, 0.0, 4);
  std::erase_if(points, [](const OrientedPoint& point) {
    const double down = std::atan2(point.position.x(), -point.position.y());
    return std::abs(down) < 40.0 * kPi / 180.0;
  });
  auto surface = surface_of(points);
  EXPECT_FALSE(trace_contour(surface, at_angle(-50.0), 0.02, 0.05, 10.0));
  const auto line = trace_open_line(surface, at_angle(-50.0), 0.02, 0.05, 10.0);
  ASSERT_TRUE(line);
  EXPECT_LT((line->points.front() - at_angle(-50.0)).norm(), 0.001);
  EXPECT_LT((line->points.back() - at_angle(230.0)).norm(), 0.07);
  for (const auto& corner : line->points) EXPECT_NEAR(corner.norm(), kRadius, 0.002);
}

TEST(ContourTrace, AClosedLineIsNoOpenOne) {
  auto surface = surface_of(test::sphere_points(kRadius, 4000, 0.0, 1));
  EXPECT_FALSE(trace_open_line(surface, {kRadius, 0.0}, 0.02, 0.2, 10.0));
}

}  // namespace
}  // namespace instep
