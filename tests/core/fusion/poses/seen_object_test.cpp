#include "core/fusion/poses/seen_object.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace instep {
namespace {

using Eigen::Vector3d;

void add(const Vector3d& point, const Vector3d& normal, PointCloud& cloud) {
  cloud.positions.push_back(point);
  cloud.normals.push_back(normal);
}

/// The four walls of a square block of side 2 * half, its middle at `middle`.
PointCloud block(const Vector3d& middle, double half, double degrees) {
  PointCloud cloud;
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3d::UnitZ()).toRotationMatrix();
  for (int wall = 0; wall < 4; ++wall) {
    const Eigen::Matrix3d side =
        Eigen::AngleAxisd(wall * std::numbers::pi / 2.0, Vector3d::UnitZ()).toRotationMatrix();
    for (double along = -half; along <= half; along += half / 500.0) {
      add(middle + turned * side * Vector3d(half, along, 20.0), turned * side * Vector3d::UnitX(),
          cloud);
    }
  }
  return cloud;
}

PointCloud cylinder(const Vector3d& middle, double radius) {
  PointCloud cloud;
  for (int i = 0; i < 720; ++i) {
    const double angle = i * std::numbers::pi / 360.0;
    const Vector3d outward(std::cos(angle), std::sin(angle), 0.0);
    add(middle + radius * outward, outward, cloud);
  }
  return cloud;
}

TEST(TurningLever, IsThatOfASquareWorkedOutByHand) {
  // The normal of a wall passes by the middle as far as its point is from the wall's middle; the
  // mean square of that over a wall is half^2 / 3.
  for (const double degrees : {0.0, 17.0, 45.0}) {
    EXPECT_NEAR(turning_lever_mm(block({300.0, -80.0, 0.0}, 60.0, degrees)), 60.0 / std::sqrt(3.0),
                0.1);
  }
}

TEST(TurningLever, IsNothingForARoundObjectWhereverItStands) {
  EXPECT_NEAR(turning_lever_mm(cylinder({0.0, 0.0, 0.0}, 50.0)), 0.0, 1e-6);
  EXPECT_NEAR(turning_lever_mm(cylinder({250.0, 120.0, 0.0}, 50.0)), 0.0, 1e-6);
}

TEST(TurningLever, IsNothingWhereNothingStandsUpright) {
  PointCloud top;
  for (int i = 0; i < 10; ++i) add({10.0 * i, 3.0 * i, 80.0}, Vector3d::UnitZ(), top);
  EXPECT_EQ(turning_lever_mm(top), 0.0);
  EXPECT_EQ(turning_lever_mm(PointCloud{}), 0.0);
}

TEST(TurningLever, OfOneWallIsItsOwn) {
  // About an axis on its normal; a wall of 2 * 60 mm holds as a square does.
  auto walls = block({0.0, 0.0, 0.0}, 60.0, 0.0);
  const std::size_t one = walls.size() / 4;
  walls.positions.resize(one);
  walls.normals.resize(one);
  EXPECT_NEAR(turning_lever_mm(walls), 60.0 / std::sqrt(3.0), 0.1);
}

}  // namespace
}  // namespace instep
