#include "core/girth/unfollowed_skin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/girth/girth.h"
#include "tests/support/circle_contour.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::kCylinderRadius;

constexpr double kRadius = 0.35;
constexpr double kGrain = 0.01;

/// At a distance outwards from the circle, towards x.
OrientedPoint out_at(double off, double height = 0.0) {
  return {{kRadius + off, 0.0, height}, Vector3d::UnitY(), 0.0};
}

/// A line of points that leads outwards, a grain apart.
std::vector<OrientedPoint> line_out(double from, double to, double height = 0.0) {
  std::vector<OrientedPoint> line;
  for (double off = from; off <= to + 1e-9; off += kGrain) line.push_back(out_at(off, height));
  return line;
}

UnfollowedSkin skin_of(std::vector<OrientedPoint> points, const Contour* other = nullptr) {
  const PlaneBand band{.middle_mm = {0, 0},
                       .points = std::move(points),
                       .index = PointIndex({}),
                       .sources = {},
                       .seen = {},
                       .grain = kGrain,
                       .uneven = {},
                       .scattered = {},
                       .roughness = {}};
  const Contour section = test::circle_contour(kRadius, 3600);
  const ContourIndex index(section);
  if (other == nullptr) return unfollowed_skin(band, section, {&index});
  const ContourIndex of_other(*other);
  return unfollowed_skin(band, section, {&index, &of_other});
}

/// How much longer than a circle a tape is that also goes round a point off it: two tangents and
/// the arc between them.
double longer_round_point(double off) {
  const double away = kRadius + off;
  return 2.0 * std::sqrt(away * away - kRadius * kRadius) -
         2.0 * kRadius * std::acos(kRadius / away);
}

TEST(UnfollowedSkin, IsWhatLeadsAwayFromTheSectionAndASpacingMore) {
  const auto skin = skin_of(line_out(0.01, 0.15));
  EXPECT_GT(skin.off, 0.15 + kGrain);
  EXPECT_LT(skin.off, 0.15 + 4.1 * kGrain);
  EXPECT_DOUBLE_EQ(skin.contact, 2.0 * skin.off);
  EXPECT_GT(skin.stretched, longer_round_point(0.15));
  EXPECT_LT(skin.stretched, 1.5 * longer_round_point(0.15));
}

TEST(UnfollowedSkin, InsideLengthensTheContactAlone) {
  const auto skin = skin_of(line_out(-0.10, -0.01));
  EXPECT_GT(skin.contact, 0.20);
  EXPECT_NEAR(skin.stretched, 0.0, 1e-12);
}

TEST(UnfollowedSkin, IsNothingWithoutAnyPoint) {
  EXPECT_FALSE(skin_of({}).is_any());
}

TEST(UnfollowedSkin, IsNothingThatLiesOnTheSection) {
  EXPECT_FALSE(skin_of(std::vector(10, out_at(0.6 * kGrain))).is_any());
  EXPECT_TRUE(skin_of(std::vector(10, out_at(0.8 * kGrain))).is_any());
}

TEST(UnfollowedSkin, IsNothingThatNoiseExplains) {
  auto points = line_out(0.02, 0.10);
  for (auto& point : points) point.variance = 0.02 * 0.02;
  EXPECT_FALSE(skin_of(points).is_any());
  for (auto& point : points) point.variance = 0.002 * 0.002;
  EXPECT_TRUE(skin_of(points).is_any());
}

TEST(UnfollowedSkin, IsToldBySparsePointsFurtherFromThePlaneThanByDense) {
  std::vector<OrientedPoint> sparse;
  for (double off = 0.05; off < 0.15; off += 0.01) sparse.push_back(out_at(off, 0.4 * kGrain));
  EXPECT_TRUE(skin_of(sparse).is_any());
  std::vector<OrientedPoint> dense;
  for (double off = 0.05; off < 0.15; off += 0.001) dense.push_back(out_at(off, 0.41 * kGrain));
  EXPECT_FALSE(skin_of(dense).is_any());
}

TEST(UnfollowedSkin, IsNotToldBeyondAnEdge) {
  // At the height h a shelf may stand out by 2 h.
  std::vector<OrientedPoint> shelf;
  for (int i = 0; i < 20; ++i) {
    const double height = 0.03 * i / 19;
    shelf.push_back(out_at(1.9 * height, height));
  }
  EXPECT_FALSE(skin_of(shelf).is_any());
}

TEST(UnfollowedSkin, IsNotToldBySkinThatHardlyCrossesThePlane) {
  auto points = line_out(0.05, 0.15);
  for (auto& point : points) point.normal = Vector3d(0.1, 0.0, 1.0).normalized();
  EXPECT_FALSE(skin_of(points).is_any());
}

TEST(UnfollowedSkin, IsNotToldByStraysOrABodyThatStandsOff) {
  EXPECT_FALSE(skin_of(line_out(0.02, 0.08)).is_any()) << "seven points";
  EXPECT_TRUE(skin_of(line_out(0.02, 0.09)).is_any());
  EXPECT_FALSE(skin_of(line_out(0.11, 0.25)).is_any());
}

TEST(UnfollowedSkin, IsNothingThatAnotherLoopFollows) {
  Contour other = test::circle_contour(0.04, 3600);
  for (auto& point : other.points) point.x() += kRadius + 0.06;
  std::vector<OrientedPoint> round;
  for (std::size_t i = 0; i < other.points.size(); i += 90) {
    const auto& outward = other.outward[i];
    const auto& place = other.points[i];
    round.push_back({{place.x(), place.y(), 0.0}, {outward.x(), outward.y(), 0.0}, 0.0});
  }
  EXPECT_FALSE(skin_of(round, &other).is_any());

  // Unless points on no loop lead there.
  round.push_back(out_at(0.01));
  EXPECT_GT(skin_of(round, &other).off, 0.10);
}

/// The cylinder of the tests with a fin along it, square at its tip.
struct FinnedCylinder {
  double half_thickness_mm;
  double height_mm;
  double share_of_points;  ///< against those on the cylinder, for the same area

  PointCloud cloud(std::size_t count, std::uint64_t seed) const {
    test::RandomNumbers random(seed);
    const double tip = kCylinderRadius + height_mm;
    const double round = test::kCylinderGirth;
    const double along_fin = 2.0 * (height_mm + half_thickness_mm);
    const double share = share_of_points * along_fin / (round + share_of_points * along_fin);
    PointCloud cloud;
    while (cloud.positions.size() < count) {
      const double z = -30.0 + 60.0 * random.uniform();
      if (random.uniform() < share) {
        const double way = along_fin * random.uniform() - 0.5 * along_fin;
        const double up = std::min(std::abs(way), height_mm);
        const double across = half_thickness_mm + height_mm - std::max(std::abs(way), height_mm);
        const double x = kCylinderRadius + up;
        cloud.positions.emplace_back(std::min(x, tip), std::copysign(across, way), z);
        continue;
      }
      const double angle = 2.0 * std::numbers::pi * random.uniform();
      const Vector3d place(kCylinderRadius * std::cos(angle), kCylinderRadius * std::sin(angle), z);
      if (place.x() > 0.0 && std::abs(place.y()) < half_thickness_mm) continue;
      cloud.positions.push_back(place);
    }
    return cloud;
  }

  double stretched_mm() const {
    const double tip = kCylinderRadius + height_mm;
    const double away = std::hypot(tip, half_thickness_mm);
    const double covered = std::atan2(half_thickness_mm, tip) + std::acos(kCylinderRadius / away);
    return 2.0 * std::sqrt(away * away - kCylinderRadius * kCylinderRadius) +
           2.0 * half_thickness_mm + 2.0 * kCylinderRadius * (std::numbers::pi - covered);
  }
};

/// Fins, seen more sparsely than what they stand on, were cut off at their roots: girths were up to
/// 15 mm short, with intervals of 0.3 mm and mostly no warning.
TEST(UnfollowedSkin, OfAThinFinIsWithinTheIntervalOrRefused) {
  for (const double half_thickness : {1.0, 1.25, 1.5}) {
    for (const double share : {0.1, 0.25, 0.5}) {
      const FinnedCylinder body{half_thickness, 15.0, share};
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const auto girth = girth_by_rbf(body.cloud(60000, seed), test::level_plane());
        if (!girth) continue;
        const double error = std::abs(girth->stretched_mm - body.stretched_mm());
        // What 95 % leave to chance is small; a fin is 15 mm.
        EXPECT_LE(error, std::max(1.0, *girth->stretched_u95_mm))
            << half_thickness << " " << share << " " << seed;
        EXPECT_TRUE(error < 1.0 || !girth->warnings.empty());
      }
    }
  }
}

}  // namespace
}  // namespace instep
