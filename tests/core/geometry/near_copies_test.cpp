#include "core/geometry/near_copies.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points drawn(int count, double size, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(0.0, size), random.uniform(0.0, size),
                        random.uniform(0.0, size));
  }
  return points;
}

/// The definition, asked of every point by looking at all before it.
std::vector<bool> by_definition(const Points& points, double apart) {
  std::vector<bool> copies;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool is_copy = false;
    for (std::size_t j = 0; j < i; ++j) {
      is_copy = is_copy || (!copies[j] && (points[i] - points[j]).norm() <= apart);
    }
    copies.push_back(is_copy);
  }
  return copies;
}

TEST(NearCopies, AreThoseNearToOneThatStays) {
  for (const double apart : {0.02, 0.1, 0.5, 3.0}) {
    const auto points = drawn(600, 1.0, 3);
    EXPECT_EQ(near_copies(points, apart), by_definition(points, apart)) << apart;
  }
}

TEST(NearCopies, LeaveSomeOfACrowdInALine) {
  Points line;
  for (int i = 0; i < 1000; ++i) line.emplace_back(0.001 * i, 0.0, 0.0);
  const auto copies = near_copies(line, 0.1);
  EXPECT_NEAR(static_cast<double>(std::count(copies.begin(), copies.end(), false)), 10.0, 1.0);
}

TEST(NearCopies, AreFoundInAMillionPointsAtOnePlace) {
  const Points crowd = drawn(1000000, 1e-6, 5);
  const auto copies = near_copies(crowd, 0.01);
  EXPECT_EQ(std::count(copies.begin(), copies.end(), false), 1);
}

TEST(NearCopies, AreCountedBySample) {
  Points points = drawn(2000, 100.0, 7);
  EXPECT_LT(share_of_near_copies(PointIndex(points), 0.01, 200), 0.02);
  for (std::size_t i = 0; i < 1000; ++i) {
    points.push_back(points[i] + Eigen::Vector3d(0.005, 0.0, 0.0));
  }
  EXPECT_NEAR(share_of_near_copies(PointIndex(points), 0.01, 200), 2.0 / 3.0, 0.1);
  EXPECT_EQ(share_of_near_copies(PointIndex({}), 0.01, 200), 0.0);
}

}  // namespace
}  // namespace instep
