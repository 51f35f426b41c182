#include "core/surface/heights/height_base.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Eigen::Matrix3d kAxes =
    Eigen::AngleAxisd(0.8, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
const Vector3d kCentre(10, -20, 30);
constexpr double kRadius = 4.0;

/// The position that has these coordinates in the axes' frame, in unit scale.
Vector3d position(const Vector3d& local) {
  return kCentre + kRadius * kAxes.transpose() * local;
}

/// On a cylinder that is bent so far: at an angle round it, so far along it and so high over it.
Vector3d over_cylinder(double bend, double angle, double along, double height) {
  const double away = 1.0 / bend + height;
  return position({away * std::sin(angle), along, away * std::cos(angle) - 1.0 / bend});
}

TEST(HeightBase, IsAPlaneWhereItIsNotBent) {
  const HeightBase plane(kAxes, kCentre, kRadius);
  for (const auto& base : {plane, plane.bent(0.0), plane.bent(1e-9)}) {
    const auto spot = base.see(position({0.4, -0.7, 0.2}));
    EXPECT_NEAR((spot.place - Vector2d(0.4, -0.7)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(spot.height, 0.2, 1e-12);
  }
}

TEST(HeightBase, SeesPlacesOfACylinder) {
  for (const double bend : {0.6, 0.2, -0.2, -0.6}) {
    const HeightBase base = HeightBase(kAxes, kCentre, kRadius).bent(bend);
    for (const double way : {-0.9, -0.3, 0.0, 0.7}) {
      for (const double height : {-0.2, 0.0, 0.3}) {
        const auto spot = base.see(over_cylinder(bend, way * bend, 0.5, height));
        EXPECT_NEAR((spot.place - Vector2d(way, 0.5)).norm(), 0.0, 1e-12) << bend << " " << way;
        EXPECT_NEAR(spot.height, height, 1e-12) << bend << " " << way;
      }
    }
  }
}

TEST(HeightBase, IsBentNoFurtherThanItsOtherSideAllows) {
  const HeightBase base(kAxes, kCentre, kRadius);
  const Vector3d somewhere = position({0.5, 0.1, -0.3});
  EXPECT_EQ(base.bent(5.0).see(somewhere).height, base.bent(0.7).see(somewhere).height);
  EXPECT_EQ(base.bent(-5.0).see(somewhere).height, base.bent(-0.7).see(somewhere).height);
}

/// A height over the base that is a function of the place, told as a field: its gradient is that of
/// differences.
TEST(HeightBase, KnowsGradients) {
  const auto height_at = [](const Vector2d& p) { return 0.1 * p.x() - 0.2 * p.x() * p.y(); };
  const auto slope_at = [](const Vector2d& p) { return Vector2d(0.1 - 0.2 * p.y(), -0.2 * p.x()); };
  for (const double bend : {0.65, 0.0, -0.4}) {
    const HeightBase base = HeightBase(kAxes, kCentre, kRadius).bent(bend);
    const auto field = [&](const Vector3d& at) {
      const auto spot = base.see(at);
      return kRadius * (spot.height - height_at(spot.place));
    };
    for (const Vector3d& local : {Vector3d(0.6, -0.4, -0.1), Vector3d(-0.7, 0.3, 0.05)}) {
      const Vector3d at = position(local);
      const auto spot = base.see(at);
      const Vector3d gradient = base.gradient(slope_at(spot.place), spot);
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d step = 1e-5 * Vector3d::Unit(axis);
        EXPECT_NEAR(gradient[axis], (field(at + step) - field(at - step)) / 2e-5, 1e-8) << bend;
      }
    }
  }
}

TEST(HeightBase, TellsThePlanesSlopeByANormal) {
  const HeightBase plane(kAxes, kCentre, kRadius);
  const Vector2d slope(0.3, -0.5);
  const Vector3d normal = plane.gradient(slope, plane.see(kCentre)).normalized();
  EXPECT_NEAR((plane.slope_of(normal) - slope).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace instep
