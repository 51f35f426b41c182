#include "core/girth/rough_tape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// A long box, 100 x 50 mm across.
Points box(std::size_t count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double way = random.uniform(0.0, 150.0);
    const double side = random.uniform(0.0, 1.0) < 0.5 ? 1.0 : -1.0;
    const double z = random.uniform(-20.0, 20.0);
    points.push_back(way < 100.0 ? Vector3d(way - 50.0, 25.0 * side, z)
                                 : Vector3d(50.0 * side, way - 125.0, z));
  }
  return points;
}

TEST(RoughTape, IsAboutTheGirth) {
  const auto tape = rough_tape(test::cylinder(6000).positions, test::level_plane());
  ASSERT_TRUE(tape);
  EXPECT_NEAR(*tape, test::kCylinderGirth, 1.0);
}

TEST(RoughTape, GoesRoundCorners) {
  const auto tape = rough_tape(box(6000, 1), test::level_plane());
  ASSERT_TRUE(tape);
  EXPECT_NEAR(*tape, 300.0, 9.0) << "sharp corners are cut by a sector";
}

TEST(RoughTape, PassesOverPointsThatStandAlone) {
  const Points skin = test::cylinder(6000).positions;
  const double girth = rough_tape(skin, test::level_plane()).value();
  for (const double off : {6.0, 15.0, 40.0}) {
    Points with_strays = skin;
    for (const double angle : {0.3, 2.0, 4.5}) {
      with_strays.emplace_back((40.0 + off) * std::cos(angle), (40.0 + off) * std::sin(angle), 0.5);
    }
    // Strays far off move the middle, from which the sectors are seen.
    EXPECT_NEAR(rough_tape(with_strays, test::level_plane()).value(), girth, 0.5) << off;
  }
}

TEST(RoughTape, IsNoneWherePointsAreFew) {
  EXPECT_FALSE(rough_tape({}, test::level_plane()));
  EXPECT_FALSE(rough_tape(Points(10, Vector3d(1.0, 2.0, 0.0)), test::level_plane()));
}

}  // namespace
}  // namespace instep
