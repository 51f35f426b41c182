#include "core/geometry/fitted_plane.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

using Eigen::Vector3d;

/// Of four points round (10, 20, 30) on a plane that is square to (0, 0.6, 0.8).
FittedPlane tilted_plane() {
  const Vector3d middle(10.0, 20.0, 30.0);
  const Vector3d along(0.0, 0.8, -0.6);
  Moments moments;
  for (const Vector3d& arm : {Vector3d(2.0, 0.0, 0.0), Vector3d(-2.0, 0.0, 0.0)}) {
    moments.add(arm);
    moments.add(0.5 * arm.x() * along);
  }
  return plane_of(moments, middle);
}

TEST(FittedPlane, GoesThroughTheMiddleOfThePointsAndTellsHeightsOverIt) {
  const FittedPlane plane = tilted_plane().facing(Vector3d::UnitZ());
  EXPECT_NEAR((plane.middle - Vector3d(10.0, 20.0, 30.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((plane.normal - Vector3d(0.0, 0.6, 0.8)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(plane.height({10.0, 20.0, 35.0}), 4.0, 1e-9);
  EXPECT_NEAR(plane.height({10.0, 20.0, 25.0}), -4.0, 1e-9);
  EXPECT_NEAR(plane.distance({10.0, 20.0, 25.0}), 4.0, 1e-9);
}

TEST(FittedPlane, FacesWhereItIsTurned) {
  const FittedPlane plane = tilted_plane();
  EXPECT_GT(plane.facing(Vector3d::UnitZ()).normal.z(), 0.0);
  EXPECT_LT(plane.facing(-Vector3d::UnitZ()).normal.z(), 0.0);
  EXPECT_EQ(plane.facing(-Vector3d::UnitZ()).middle, plane.middle);
}

}  // namespace
}  // namespace instep
