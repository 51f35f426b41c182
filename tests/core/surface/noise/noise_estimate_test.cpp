#include "core/surface/noise/noise_estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

std::vector<std::size_t> every(std::size_t step, const Points& points) {
  std::vector<std::size_t> places;
  for (std::size_t i = step / 2; i < points.size(); i += step) places.push_back(i);
  return places;
}

NoiseEstimate estimate(const Points& points, const std::vector<double>& told = {}) {
  return estimate_noise(PointIndex(points), every(points.size() / 40 + 1, points), told);
}

Points sphere(double sigma, std::uint64_t seed) {
  return test::positions_of(test::sphere_points(0.5, 4000, sigma, seed));
}

double middle_roughness(const NoiseEstimate& noise) {
  std::vector<double> all;
  for (const auto& known : noise.roughness) all.push_back(known.roughness);
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2),
                   all.end());
  return all.at(all.size() / 2);
}

TEST(NoiseEstimate, MeetsTheNoiseOfASphere) {
  for (const double sigma : {0.001, 0.003, 0.01}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      EXPECT_NEAR(estimate(sphere(sigma, seed)).sigma, sigma, 0.15 * sigma) << "seed " << seed;
    }
  }
}

/// Of 480 of them the noise is as thick as they are wide: it was told as three fifths of it.
TEST(NoiseEstimate, MeetsNoiseThickerThanManyNeighboursAreWide) {
  const double sigma = 0.02;
  const auto points = test::positions_of(test::sphere_points(0.5, 300000, sigma, 1));
  EXPECT_NEAR(estimate(points).sigma, sigma, 0.15 * sigma);
}

TEST(NoiseEstimate, FindsAlmostNoneInAnExactCloud) {
  EXPECT_LT(estimate(sphere(0.0, 1)).sigma, 1e-5);
  EXPECT_LT(estimate(test::positions_of(test::prism_points(1.0, 0.5, 0.03, 0.0, 1))).sigma, 1e-4);
}

TEST(NoiseEstimate, IsNotMisledByCreases) {
  const double sigma = 0.003;
  const auto prism = test::positions_of(test::prism_points(1.0, 1.0, 0.025, sigma, 2));
  EXPECT_NEAR(estimate(prism).sigma, sigma, 0.2 * sigma);
}

TEST(NoiseEstimate, IsNotMisledByAFewStrays) {
  const double sigma = 0.003;
  auto points = sphere(sigma, 4);
  test::RandomNumbers random(5);
  for (int i = 0; i < 20; ++i) points[random.below(points.size())] *= random.uniform(1.05, 1.3);
  EXPECT_NEAR(estimate(points).sigma, sigma, 0.2 * sigma);
}

/// The places of a ring round the sphere, in their order.
std::vector<std::size_t> ring_of(const Points& points) {
  std::vector<std::size_t> ring;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(points[i].z()) < 0.02) ring.push_back(i);
  }
  std::sort(ring.begin(), ring.end(), [&](std::size_t a, std::size_t b) {
    return std::atan2(points[a].y(), points[a].x()) < std::atan2(points[b].y(), points[b].x());
  });
  return ring;
}

TEST(NoiseEstimate, TellsUnevenNoiseFromEven) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const auto same = sphere(0.003, seed);
    EXPECT_TRUE(estimate_noise(PointIndex(same), ring_of(same), {}).uneven.empty()) << seed;
    auto points = test::positions_of(test::sphere_points(0.5, 4000, 0.0, seed));
    test::RandomNumbers random(seed);
    const auto sigma_of = [](const Vector3d& point) { return point.x() > 0.0 ? 0.006 : 0.0015; };
    for (auto& point : points) point *= 1.0 + sigma_of(point) * random.normal() / 0.5;
    const auto noise = estimate_noise(PointIndex(points), ring_of(points), {});
    ASSERT_FALSE(noise.uneven.empty()) << seed;
    for (const auto& local : noise.uneven) {
      if (local.place.x() > -0.3 && local.place.x() < 0.15) continue;  // reach over the step
      EXPECT_NEAR(std::log(noise.sigma * local.times / sigma_of(local.place)), 0.0, 0.3) << seed;
    }
    EXPECT_NEAR(noise.sigma, std::hypot(0.006, 0.0015) / std::sqrt(2.0), 0.001);
  }
}

TEST(NoiseEstimate, KeepsWhatIsToldThoughThePointsShowLess) {
  const auto noise = estimate(sphere(0.003, 6), std::vector<double>(4000, 0.007));
  EXPECT_DOUBLE_EQ(noise.sigma, 0.007);
  EXPECT_EQ(noise.told_scale, 1.0);
  EXPECT_NEAR(noise.shown, 0.003, 0.15 * 0.003);
  ASSERT_FALSE(noise.roughness.empty());
  for (const auto& known : noise.roughness) EXPECT_GT(known.roughness, 0.0);
}

TEST(NoiseEstimate, BelievesWhatIsToldRightly) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto noise = estimate(sphere(0.003, seed), std::vector<double>(4000, 0.003));
    EXPECT_DOUBLE_EQ(noise.sigma, 0.003) << seed;
    EXPECT_EQ(noise.told_scale, 1.0) << seed;
  }
}

TEST(NoiseEstimate, RaisesWhatIsToldToWhatThePointsShow) {
  for (const double part : {0.01, 0.1, 0.3, 0.6}) {
    const auto noise = estimate(sphere(0.003, 8), std::vector<double>(4000, part * 0.003));
    EXPECT_NEAR(noise.sigma, 0.003, 0.1 * 0.003) << part;
    EXPECT_NEAR(noise.told_scale, 1.0 / part, 0.1 / part) << part;
  }
}

/// Each neighbourhood is held against what is told of it, not of others.
TEST(NoiseEstimate, TellsTooLittleFromUneven) {
  auto points = test::positions_of(test::sphere_points(0.5, 4000, 0.0, 9));
  test::RandomNumbers random(9);
  std::vector<double> told;
  for (auto& point : points) {
    told.push_back(point.x() > 0.0 ? 0.006 : 0.001);
    point *= 1.0 + told.back() * random.normal() / 0.5;
  }
  EXPECT_EQ(estimate(points, told).told_scale, 1.0);
  for (double& sigma : told) sigma /= 3.0;
  EXPECT_NEAR(estimate(points, told).told_scale, 3.0, 0.4);
}

/// Points of two cameras among each other: each was held against what is told of one of them.
TEST(NoiseEstimate, BelievesWhatIsToldOfNeighboursThatDiffer) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    Points points = sphere(0.0, seed);
    std::vector<double> told;
    test::RandomNumbers random(seed);
    for (auto& point : points) {
      told.push_back(random.uniform(0.0, 1.0) < 0.5 ? 0.01 : 0.001);
      point *= 1.0 + told.back() * random.normal() / 0.5;
    }
    const auto noise = estimate_noise(PointIndex(points), ring_of(points), told);
    EXPECT_EQ(noise.told_scale, 1.0) << seed;
    EXPECT_TRUE(noise.uneven.empty()) << seed;
    for (double& sigma : told) sigma /= 3.0;
    EXPECT_NEAR(estimate(points, told).told_scale, 3.0, 0.5) << seed;
  }
}

TEST(NoiseEstimate, RaisesWhatIsToldWhereThePointsShowMore) {
  auto points = test::positions_of(test::sphere_points(0.5, 4000, 0.0, 10));
  test::RandomNumbers random(10);
  const auto times_of = [](const Eigen::Vector3d& place) { return place.x() > 0.2 ? 4.0 : 1.0; };
  for (auto& point : points) point *= 1.0 + 0.001 * times_of(point) * random.normal() / 0.5;
  const std::vector<double> told(points.size(), 0.001);
  const auto noise = estimate_noise(PointIndex(points), ring_of(points), told);
  ASSERT_FALSE(noise.uneven.empty());
  EXPECT_NEAR(noise.told_scale, noise.sigma / 0.001, 1e-9);
  for (const auto& local : noise.uneven) {
    if (local.place.x() > -0.1 && local.place.x() < 0.35) continue;  // reach over the step
    EXPECT_NEAR(std::log(noise.told_scale * local.times / times_of(local.place)), 0.0, 0.3);
  }
}

TEST(NoiseEstimate, TellsTheRoughnessOfSomeFortyPlaces) {
  const auto points = sphere(0.003, 7);
  const auto noise = estimate_noise(PointIndex(points), every(1, points), {});
  EXPECT_GE(noise.roughness.size(), 20U);
  EXPECT_LE(noise.roughness.size(), 60U);
  for (const auto& known : noise.roughness) {
    EXPECT_GT(known.roughness, 0.0);
    EXPECT_NEAR(known.place.norm(), 0.5, 0.02) << "not on the surface";
  }
}

/// Waves of the same height over and over against none, under the same noise.
TEST(NoiseEstimate, FindsWavesRougherThanAnEvenSphere) {
  auto waves = test::sphere_points(0.5, 4000, 0.001, 8);
  for (auto& point : waves) point.position *= 1.0 + 0.02 * std::sin(60.0 * point.position.z());
  const std::vector<double> even(4000, 0.001);
  EXPECT_GT(middle_roughness(estimate(test::positions_of(waves), even)),
            5.0 * middle_roughness(estimate(sphere(0.001, 8), even)));
}

TEST(NoiseEstimate, IsTheSameInAnyUnit) {
  auto points = sphere(0.003, 9);
  const auto noise = estimate(points);
  for (auto& point : points) point *= 1e3;
  const auto other = estimate(points);
  EXPECT_NEAR(other.sigma, 1e3 * noise.sigma, 1e-6 * other.sigma);
  ASSERT_EQ(other.roughness.size(), noise.roughness.size());
  // A variogram, a square of lengths over a cube of them.
  for (std::size_t i = 0; i < noise.roughness.size(); ++i) {
    EXPECT_NEAR(1e3 * other.roughness[i].roughness, noise.roughness[i].roughness,
                1e-4 * noise.roughness[i].roughness);
  }
}

TEST(NoiseEstimate, OrderOfPointsDoesNotMatter) {
  const auto points = sphere(0.003, 10);
  const auto places = every(110, points);
  Points turned(points.rbegin(), points.rend());
  std::vector<std::size_t> turned_places;
  for (const auto place : places) turned_places.push_back(points.size() - 1 - place);
  const auto noise = estimate_noise(PointIndex(points), places, {});
  const auto other = estimate_noise(PointIndex(turned), turned_places, {});
  EXPECT_NEAR(other.sigma, noise.sigma, 1e-9);
}

TEST(NoiseEstimate, IsFiniteForAnything) {
  Points line;
  for (int i = 0; i < 100; ++i) line.emplace_back(0.01 * i, 0.02 * i, 0.0);
  test::RandomNumbers random(11);
  Points cloud;
  for (int i = 0; i < 300; ++i) {
    cloud.emplace_back(random.uniform(), random.uniform(), random.uniform());
  }
  Points twice = sphere(0.003, 12);
  twice.insert(twice.end(), twice.begin(), twice.begin() + 2000);
  for (const auto& points : {line, cloud, twice, Points(50, Vector3d(1, 2, 3)), Points{{0, 0, 0}},
                             Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}) {
    const auto noise = estimate_noise(PointIndex(points), every(1, points), {});
    EXPECT_TRUE(std::isfinite(noise.sigma));
    EXPECT_GE(noise.sigma, 0.0);
    for (const auto& known : noise.roughness) {
      EXPECT_TRUE(std::isfinite(known.roughness));
      EXPECT_GT(known.roughness, 0.0);
    }
  }
}

std::optional<NoiseEstimate> if_exact(const Points& points) {
  return estimate_if_exact(PointIndex(points), ring_of(points));
}

TEST(NoiseEstimateIfExact, IsThatOfExactPointsAlone) {
  const auto exact = if_exact(sphere(0.0, 13));
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->sigma, 0.0);
  EXPECT_TRUE(exact->uneven.empty());
  EXPECT_GE(exact->roughness.size(), 8U);
  for (const double sigma : {1e-5, 3e-4, 0.003}) EXPECT_FALSE(if_exact(sphere(sigma, 13))) << sigma;
}

/// Wherever the part is: those who ask every third place saw half of these.
TEST(NoiseEstimateIfExact, SeesNoiseInAFiftiethOfTheRing) {
  for (int turn = 0; turn < 36; ++turn) {
    auto points = sphere(0.0, 15);
    test::RandomNumbers random(15);
    for (auto& point : points) {
      const double off = std::atan2(point.y(), point.x()) - 0.17 * turn;
      if (std::abs(std::remainder(off, 2.0 * std::numbers::pi)) > std::numbers::pi / 50.0) continue;
      point *= 1.0 + 0.002 * random.normal();
    }
    EXPECT_FALSE(if_exact(points)) << turn;
  }
}

/// Waves of twice the height wander by four times as much.
TEST(NoiseEstimateIfExact, FindsHigherWavesRougher) {
  const auto disc = test::disc_points(Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 4000, 0.0, 16);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < disc.size(); i += 60) {
    if (disc[i].position.norm() < 0.7) places.push_back(i);
  }
  const auto roughness = [&](double height, double often) {
    auto waves = test::positions_of(disc);
    for (auto& place : waves) place.z() = height * std::sin(often * (place.x() + 0.4 * place.y()));
    const auto noise = estimate_if_exact(PointIndex(waves), places);
    return noise ? middle_roughness(*noise) : 0.0;
  };
  for (const double often : {3.0, 5.0}) {
    EXPECT_NEAR(roughness(0.002, often) / roughness(0.001, often), 4.0, 0.4) << often;
  }
}

TEST(NoiseEstimateIfExact, IsNothingWithoutPlaces) {
  const auto points = sphere(0.0, 17);
  EXPECT_FALSE(estimate_if_exact(PointIndex(points), {}));
  EXPECT_FALSE(if_exact({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(RoughnessAt, ComesFromTheNearestPlaces) {
  std::vector<LocalRoughness> known;
  for (int i = 0; i < 20; ++i) {
    known.push_back({{0.01 * i, 0.0, 0.0}, 2.0});
    known.push_back({{50.0 + 0.01 * i, 0.0, 0.0}, 7.0});
  }
  EXPECT_NEAR(roughness_at(known, {0.1, 1.0, 0.0}), 2.0, 1e-3);
  EXPECT_NEAR(roughness_at(known, {49.0, 0.0, 0.0}), 7.0, 1e-3);
  EXPECT_NEAR(roughness_at({{Vector3d::Zero(), 3.0}}, {9, 9, 9}), 3.0, 1e-12);
  EXPECT_GT(roughness_at({}, Vector3d::Zero()), 0.0);
  EXPECT_LT(roughness_at({}, Vector3d::Zero()), 0.1);
}

}  // namespace
}  // namespace instep
