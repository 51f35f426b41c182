#include "core/surface/patches/height_patch.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"
#include "tests/support/wavy_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

constexpr double kSphere = 2.0;
const Vector3d kTop(0, 0, kSphere);

HeightPatch cap_patch(const OrientedPoints& points) {
  return HeightPatch::fit(points, kTop, Vector3d::UnitZ(), 1.0, 0.01).value();
}

/// Over the unit disc under a cap of the sphere, off the sphere by `distance`.
Vector3d near_cap(double x, double y, double distance = 0.0) {
  const double z = std::sqrt(kSphere * kSphere - x * x - y * y);
  return (1.0 + distance / kSphere) * Vector3d(x, y, z);
}

TEST(HeightPatch, OfAPlaneIsTheDistanceFromIt) {
  const Vector3d normal = Vector3d(1, -2, 3).normalized();
  const Vector3d middle(5, 6, -7);
  for (const std::size_t count : {4U, 5U, 30U, 300U}) {
    const auto points = test::disc_points(middle, normal, 2.0, count, 0.0, 1);
    const auto patch = HeightPatch::fit(points, middle, normal, 2.0, 0.01);
    ASSERT_TRUE(patch) << count;
    for (const double distance : {-0.5, 0.0, 0.3}) {
      const Vector3d place = middle + Vector3d(0.4, 0.2, 0.0) + distance * normal;
      const double expected = normal.dot(place - middle);
      EXPECT_NEAR(patch->at(place).value, expected, 1e-9) << count;
      EXPECT_NEAR((patch->at(place).gradient - normal).norm(), 0.0, 1e-8) << count;
    }
  }
}

TEST(HeightPatch, TakesAPlaneThatIsTiltedAgainstItsAxis) {
  const Vector3d normal(std::sin(0.6), 0.0, std::cos(0.6));
  const auto points = test::disc_points(Vector3d::Zero(), normal, 1.0, 50, 0.0, 2);
  const auto patch = HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 0.01);
  ASSERT_TRUE(patch);
  const Vector3d on = 0.3 * normal.unitOrthogonal();
  EXPECT_NEAR(patch->at(on).value, 0.0, 1e-9);
  EXPECT_NEAR(patch->at(on).gradient.normalized().dot(normal), 1.0, 1e-9);
  EXPECT_GT(patch->at(on + 0.1 * normal).value, 0.09);
  EXPECT_LT(patch->at(on - 0.1 * normal).value, -0.09);
}

TEST(HeightPatch, PassesThroughExactPointsAndKeepsTheRoughnessGiven) {
  const auto points = test::cap_points(kSphere, 1.0, 55, 0.0, 3);
  const auto patch = cap_patch(points);
  for (const auto& point : points) EXPECT_NEAR(patch.at(point.position).value, 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(patch.roughness(), 0.01);
}

TEST(HeightPatch, FollowsASphereBetweenItsPoints) {
  const auto patch = cap_patch(test::cap_points(kSphere, 1.0, 60, 0.0, 4));
  for (const double x : {-0.4, 0.0, 0.3}) {
    for (const double y : {-0.3, 0.1, 0.5}) {
      const auto field = patch.at(near_cap(x, y));
      EXPECT_NEAR(field.value, 0.0, 5e-4);
      EXPECT_GT(field.gradient.normalized().dot(near_cap(x, y).normalized()), 1.0 - 1e-4);
      EXPECT_GT(patch.at(near_cap(x, y, 0.05)).value, 0.045);
      EXPECT_LT(patch.at(near_cap(x, y, -0.05)).value, -0.045);
    }
  }
}

TEST(HeightPatch, FindsWavesRougherThanAnEvenSurface) {
  const auto roughness = [](double amplitude) {
    return HeightPatch::fit(test::wavy_points(60, amplitude, 0.005, 7), Vector3d::Zero(),
                            Vector3d::UnitZ(), 1.0, 0.01)
        ->roughness();
  };
  EXPECT_GT(roughness(0.1), 5.0 * roughness(0.0));
}

void expect_gradient_of_value(const HeightPatch& patch) {
  const auto value = [&](const Vector3d& place) { return patch.at(place).value; };
  test::RandomNumbers random(9);
  for (int i = 0; i < 20; ++i) {
    const Vector3d place =
        near_cap(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.2, 0.2));
    EXPECT_NEAR((patch.at(place).gradient - test::slope_by_differences(value, place, 1e-5)).norm(),
                0.0, 1e-7);
  }
}

TEST(HeightPatch, GradientIsThatOfItsValue) {
  expect_gradient_of_value(cap_patch(test::cap_points(kSphere, 1.0, 60, 0.01, 8)));
  expect_gradient_of_value(cap_patch(test::cap_points(kSphere, 1.0, 60, 0.0, 8)));
  for (const double waves : {1.0, 0.4}) {
    expect_gradient_of_value(HeightPatch::fit(test::wavy_points(60, 0.1, 0.0, 5, waves),
                                              Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 0.05)
                                 .value());
  }
}

/// Root mean square of the distance of its middle from the true plane, over `trials` draws.
double error_on_a_plane(std::size_t count, double sigma, std::uint64_t trials) {
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    const auto points =
        test::disc_points(Vector3d::Zero(), Vector3d::UnitZ(), 1.0, count, sigma, seed);
    const auto patch = HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 1e-4);
    for (const double x : {-0.4, 0.0, 0.4}) {
      squares += std::pow(patch->at({x, 0.2, 0.0}).value, 2) / 3.0;
    }
  }
  return std::sqrt(squares / static_cast<double>(trials));
}

TEST(HeightPatch, AveragesNoiseMoreTheMorePointsItHas) {
  const double sigma = 0.02;
  EXPECT_LT(error_on_a_plane(60, sigma, 30), 0.45 * sigma);
  EXPECT_LT(error_on_a_plane(600, sigma, 30), 0.2 * sigma);
}

TEST(HeightPatch, AveragingOverCellsDoesNotBendACurvedSurface) {
  const auto patch = cap_patch(test::cap_points(kSphere, 1.0, 3000, 1e-6, 10));
  for (const double x : {-0.5, -0.2, 0.0, 0.3, 0.6}) {
    EXPECT_NEAR(patch.at(near_cap(x, 0.1)).value, 0.0, 3e-4) << x;
  }
}

/// Over the unit disc under a cap of the sphere, on square facets whose corners lie on it.
OrientedPoints faceted_points(std::size_t count, double side, std::uint64_t seed) {
  OrientedPoints points;
  for (auto point : test::disc_points(Vector3d::Zero(), Vector3d::UnitZ(), 1.0, count, 0.0, seed)) {
    Vector3d& at = point.position;
    const double left = side * std::floor(at.x() / side);
    const double low = side * std::floor(at.y() / side);
    const double u = (at.x() - left) / side;
    const double v = (at.y() - low) / side;
    at.z() = (1 - u) * (1 - v) * near_cap(left, low).z() +
             u * (1 - v) * near_cap(left + side, low).z() +
             (1 - u) * v * near_cap(left, low + side).z() +
             u * v * near_cap(left + side, low + side).z();
    points.push_back(point);
  }
  return points;
}

TEST(HeightPatch, BendsAtTheSmallestScaleOnFacetsAndHardlyOnASphere) {
  double smooth = 0.0;
  double faceted = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    smooth += cap_patch(test::cap_points(kSphere, 1.0, 60, 0.0, seed)).fine_bending() / 10.0;
    faceted += cap_patch(faceted_points(60, 0.22, seed)).fine_bending() / 10.0;
  }
  EXPECT_LT(smooth, 0.6);
  EXPECT_GT(faceted, 0.8);
}

/// A point that is lifted off the sphere is missed by that, and the others by less.
TEST(HeightPatch, MissesALiftedPointMost) {
  constexpr double kLift = 0.01;
  constexpr std::size_t kLifted = 7;
  auto points = test::cap_points(kSphere, 1.0, 60, 0.0, 4);
  for (const double missed : cap_patch(points).missed()) EXPECT_LT(std::abs(missed), 0.2 * kLift);
  points[kLifted].position *= 1.0 + kLift / kSphere;
  const auto missed = cap_patch(points).missed();
  ASSERT_EQ(missed.size(), points.size());
  EXPECT_NEAR(missed[kLifted], kLift, 0.2 * kLift);
  for (std::size_t i = 0; i < missed.size(); ++i) {
    if (i != kLifted) {
      EXPECT_LT(std::abs(missed[i]), 0.8 * kLift) << i;
    }
  }
}

TEST(HeightPatch, MissesPointsOfACellByAsMuch) {
  const auto patch = cap_patch(test::cap_points(kSphere, 1.0, 500, 0.0, 4));
  const auto missed = patch.missed();
  EXPECT_EQ(missed.size(), 500U);
  EXPECT_LE(std::set<double>(missed.begin(), missed.end()).size(),
            static_cast<std::size_t>(kMostHeightSamples));
}

TEST(HeightPatch, CannotTellFineBendingFromNoise) {
  EXPECT_DOUBLE_EQ(cap_patch(test::cap_points(kSphere, 1.0, 60, 0.01, 1)).fine_bending(), 1.0);
}

TEST(HeightPatch, SpansAHole) {
  OrientedPoints rim;
  for (const auto& point : test::cap_points(kSphere, 1.0, 80, 0.0, 11)) {
    if (point.position.head<2>().norm() > 0.5) rim.push_back(point);
  }
  const auto patch = cap_patch(rim);
  // A flat cover over the hole would be 0.064 off.
  for (const double x : {-0.3, 0.0, 0.2}) EXPECT_NEAR(patch.at(near_cap(x, 0.0)).value, 0.0, 3e-3);
}

TEST(HeightPatch, IsTheSameInAnyUnit) {
  const auto points = test::cap_points(kSphere, 1.0, 60, 0.01, 12);
  const auto patch = cap_patch(points);
  for (const double factor : {1e-3, 1e3}) {
    // A variogram, a square of lengths over a cube of them.
    const auto other = HeightPatch::fit(test::scaled(points, factor), factor * kTop,
                                        Vector3d::UnitZ(), factor, 0.01 / factor);
    ASSERT_TRUE(other);
    EXPECT_NEAR(other->roughness() * factor, patch.roughness(), 1e-6 * patch.roughness());
    for (const double x : {-0.4, 0.0, 0.5}) {
      const Vector3d place = near_cap(x, 0.2, 0.1);
      EXPECT_NEAR(other->at(factor * place).value / factor, patch.at(place).value, 1e-7);
      EXPECT_NEAR((other->at(factor * place).gradient - patch.at(place).gradient).norm(), 0.0,
                  1e-6);
    }
  }
}

TEST(HeightPatch, OrderOfPointsDoesNotMatter) {
  for (const std::size_t count : {40U, 400U}) {
    const auto points = test::cap_points(kSphere, 1.0, count, 0.01, 13);
    const auto patch = cap_patch(points);
    const auto other = cap_patch(test::in_another_order(points, 14));
    for (const double x : {-0.4, 0.0, 0.5}) {
      EXPECT_NEAR(other.at(near_cap(x, 0.1)).value, patch.at(near_cap(x, 0.1)).value, 1e-9);
    }
    EXPECT_NEAR(other.misfit(), patch.misfit(), 1e-6);
  }
}

TEST(HeightPatch, APointTwiceIsAPointOfHalfTheVariance) {
  auto once = test::cap_points(kSphere, 1.0, 28, 0.01, 15);
  auto twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  for (auto& point : once) point.variance /= 2.0;
  const auto patch = cap_patch(once);
  const auto other = cap_patch(twice);
  for (const double x : {-0.4, 0.0, 0.5}) {
    EXPECT_NEAR(other.at(near_cap(x, 0.1)).value, patch.at(near_cap(x, 0.1)).value, 1e-6);
  }
}

/// Of an uneven surface: of an even one, points told twice make smoother kernels likelier.
TEST(HeightPatch, ExactDuplicatesDoNotMatter) {
  const auto points = test::uneven_points(25);
  auto twice = points;
  twice.insert(twice.end(), points.begin(), points.end());
  const auto patch_of = [](const OrientedPoints& some) {
    return HeightPatch::fit(some, Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 0.05).value();
  };
  const auto patch = patch_of(twice);
  for (const auto& point : points) EXPECT_NEAR(patch.at(point.position).value, 0.0, 1e-6);
  const Vector3d between(0.1, 0.1, 0.0);
  EXPECT_NEAR(patch.at(between).value, patch_of(points).at(between).value, 1e-6);
}

/// Their squares are beyond the range of numbers: no likelihood is left to compare.
TEST(HeightPatch, RefusesHeightsThatTellNothingOfTheirLikelihood) {
  for (const double noise : {0.0, 0.01}) {
    auto points = test::cap_points(kSphere, 1.0, 25, noise, 18);
    ASSERT_TRUE(HeightPatch::fit(points, kTop, Vector3d::UnitZ(), 1.0, 0.01));
    points[7].position.z() = 1e200;
    EXPECT_FALSE(HeightPatch::fit(points, kTop, Vector3d::UnitZ(), 1.0, 0.01)) << noise;
  }
}

TEST(HeightPatch, RefusesPointsThatDetermineNoSurface) {
  const auto fits = [](const OrientedPoints& points) {
    return HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 0.01).has_value();
  };
  OrientedPoints line;
  for (int i = -14; i <= 14; ++i) {
    line.push_back({0.07 * i * Vector3d(0.6, 0.8, 0.1), Vector3d::UnitZ(), 0.0});
  }
  for (const double variance : {0.0, 1e-4}) {
    for (auto& point : line) point.variance = variance;
    EXPECT_FALSE(fits({}));
    EXPECT_FALSE(fits(test::disc_points(Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 3, 0.0, 17)));
    EXPECT_FALSE(fits(line));
    EXPECT_FALSE(fits(OrientedPoints(20, line.front())));
  }
  EXPECT_TRUE(fits(test::disc_points(Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 4, 0.0, 17)));
}

TEST(HeightPatch, TellsAStray) {
  auto points = test::cap_points(kSphere, 1.0, 60, 0.0, 21);
  EXPECT_LT(cap_patch(points).odd_one().gain, 16.0);
  points[23].position += 0.2 * points[23].normal;
  const auto odd = cap_patch(points).odd_one();
  EXPECT_EQ(odd.points, std::vector<std::size_t>{23});
  EXPECT_GT(odd.gain, 30.0);
}

/// It cannot be told from those that it was averaged with.
TEST(HeightPatch, TellsAStrayByItsCellWherePointsAreAveraged) {
  auto points = test::cap_points(kSphere, 1.0, 400, 0.002, 22);
  EXPECT_LT(cap_patch(points).odd_one().gain, 16.0);
  points[77].position += 0.4 * points[77].normal;
  const auto odd = cap_patch(points).odd_one();
  EXPECT_GT(odd.gain, 30.0);
  EXPECT_EQ(std::count(odd.points.begin(), odd.points.end(), 77U), 1);
  EXPECT_LT(odd.points.size(), 25U);
  EXPECT_TRUE(std::is_sorted(odd.points.begin(), odd.points.end()));
  for (const std::size_t other : odd.points) {
    EXPECT_LT((points[other].position - points[77].position).head<2>().cwiseAbs().maxCoeff(),
              2.0 / 7.0 + 0.05);
  }
}

}  // namespace
}  // namespace instep
