#include "core/foot/sole/sunk_floor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// A dome as large as a foot over an unseen sole, with noise along z on either side of its axis.
FootScan dome(double noise_at_left, double noise_at_right) {
  test::RandomNumbers random(11);
  FootScan foot;
  for (int i = 0; i < 9000; ++i) {
    Vector3d way(random.normal(), random.normal(), std::abs(random.normal()));
    way.normalize();
    Vector3d place(130.0 * way.x(), 50.0 * way.y(), 60.0 * way.z());
    place.z() += (place.y() > 0.0 ? noise_at_left : noise_at_right) * random.normal();
    foot.cloud.positions.push_back(place);
  }
  foot.cloud.origins.assign(foot.cloud.size(), PointOrigin::kSeen);
  foot.cloud.origins.back() = PointOrigin::kPlatform;
  // Along the normals of the walls there is less of it.
  foot.quieted = QuietedCloud{{}, {.noise_mm = 0.3, .length_mm = 260.0}};
  return foot;
}

TEST(SunkFloor, LiesAsLowAsNoiseOfTheBackTells) {
  EXPECT_NEAR(sunk_floor_mm(dome(1.0, 1.0)), 1.0, 0.3);
  EXPECT_NEAR(sunk_floor_mm(dome(1.5, 1.5)), 2.0, 0.4);
  EXPECT_EQ(sunk_floor_mm(dome(0.3, 0.3)), 0.0);
}

TEST(SunkFloor, GoesByTheNoisierSide) {
  // Near the axis the other side has a say in it.
  EXPECT_NEAR(sunk_floor_mm(dome(0.2, 1.5)), 1.6, 0.5);
  EXPECT_NEAR(sunk_floor_mm(dome(1.5, 0.2)), 1.6, 0.5);
}

TEST(SunkFloor, IsNoneWhereItIsKnownOrTheCloudIsQuietOrTheSoleWasSeen) {
  FootScan known = dome(1.0, 1.0);
  known.is_floor_known = true;
  EXPECT_EQ(sunk_floor_mm(known), 0.0);
  FootScan quiet = dome(1.0, 1.0);
  quiet.quieted.reset();
  EXPECT_EQ(sunk_floor_mm(quiet), 0.0);
  FootScan seen = dome(1.0, 1.0);
  seen.cloud.origins.clear();
  EXPECT_EQ(sunk_floor_mm(seen), 0.0);
}

}  // namespace
}  // namespace instep
