#include "core/geometry/moments_round.h"

#include <gtest/gtest.h>

#include <cmath>

namespace instep {
namespace {

using Eigen::Vector3d;

TEST(MomentsRound, AreThoseOfTheNeighboursRoundThePlace) {
  const Vector3d place(1000.0, -500.0, 20.0);
  const PointIndex index({place + Vector3d(1.0, 0.0, 0.0), place + Vector3d(0.0, 2.0, 0.0),
                          place + Vector3d(-1.0, 0.0, 0.0), place + Vector3d(0.0, 0.0, 50.0)});
  const Moments moments = moments_round(index, place, index.nearest(place, 3));
  EXPECT_EQ(moments.count, 3.0);
  EXPECT_EQ(moments.sum, Vector3d(0.0, 2.0, 0.0));
  EXPECT_NEAR(std::abs(moments.flattest().z()), 1.0, 1e-12);
}

TEST(MomentsRound, AreNothingOfNoNeighbours) {
  const PointIndex index({Vector3d::Zero()});
  EXPECT_EQ(moments_round(index, Vector3d::UnitX(), {}).count, 0.0);
}

}  // namespace
}  // namespace instep
