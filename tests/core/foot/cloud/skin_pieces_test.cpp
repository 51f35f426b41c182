#include "core/foot/cloud/skin_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Points at random on a square of 100 by 100, one to each 2 by 2.
std::vector<Vector3d> square(double x, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<Vector3d> points;
  for (int i = 0; i < 2500; ++i) {
    points.emplace_back(x + random.uniform(0.0, 100.0), random.uniform(0.0, 100.0), 0.0);
  }
  return points;
}

std::size_t largest(const SkinPieces::Pieces& pieces) {
  std::size_t most = 0;
  for (const auto& piece : pieces) most = std::max(most, piece.size());
  return most;
}

TEST(SkinPieces, AreNoneOfNothing) {
  const SkinPieces parted({});
  EXPECT_TRUE(parted.within_reach().empty());
  EXPECT_TRUE(parted.along_skin().empty());
}

TEST(SkinPieces, OfOneSkinAreOne) {
  const SkinPieces parted(square(0.0, 1));
  EXPECT_GT(largest(parted.within_reach()), 2450U);
  EXPECT_GT(largest(parted.within_least_reach()), 1500U);
  EXPECT_GT(largest(parted.along_skin()), 2400U);
  EXPECT_NEAR(parted.usual_spacing(), 2.0, 0.4);
}

TEST(SkinPieces, AreTwoAcrossAGap) {
  auto points = square(0.0, 1);
  const auto other = square(110.0, 2);
  points.insert(points.end(), other.begin(), other.end());
  EXPECT_LE(largest(SkinPieces(points).within_reach()), 2500U);
}

/// A wall on a floor: both end where they meet.
TEST(SkinPieces, AlongTheSkinEndAtAnotherOne) {
  auto points = square(0.0, 1);
  for (const Vector3d& point : square(0.0, 2)) {
    points.emplace_back(50.0, point.y(), 1.0 + point.x());
  }
  EXPECT_GT(largest(SkinPieces(points).within_reach()), 4800U);
  EXPECT_LT(largest(SkinPieces(points).along_skin()), 2700U);
}

/// Which way a skin faces, lines of points do not tell.
TEST(SkinPieces, OfLinesFarApartAreNotParted) {
  std::vector<Vector3d> points;
  for (int line = 0; line < 20; ++line) {
    for (int i = 0; i < 100; ++i) points.emplace_back(i, 20.0 * line, 0.002 * i * i);
  }
  EXPECT_LE(largest(SkinPieces(points).along_skin()), 1U);
}

}  // namespace
}  // namespace instep
