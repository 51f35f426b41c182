#include "core/geometry/plane_vectors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace instep {
namespace {

TEST(SectorOf, OfFourIsAQuadrant) {
  EXPECT_EQ(sector_of({-2, -1}, 4), 0U);
  EXPECT_EQ(sector_of({1, -3}, 4), 1U);
  EXPECT_EQ(sector_of({1e-9, 1e-9}, 4), 2U);
  EXPECT_EQ(sector_of({-1, 5}, 4), 3U);
}

TEST(SectorOf, FollowsTheDegreesOfACircle) {
  constexpr std::size_t kCount = 360;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double turn = (static_cast<double>(i) + 0.5) / 180.0 * std::numbers::pi;
    EXPECT_EQ(sector_of({-std::cos(turn), -std::sin(turn)}, kCount), i);
  }
}

TEST(SectorOf, IsNeverBeyondTheLast) {
  for (const std::size_t count : {1U, 7U, 24U, 64U, 72U}) {
    EXPECT_EQ(sector_of({-1, 0.0}, count), count - 1);
    EXPECT_EQ(sector_of({-1, -0.0}, count), 0U);
  }
}

}  // namespace
}  // namespace instep
