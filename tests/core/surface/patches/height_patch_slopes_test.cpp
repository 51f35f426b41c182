#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/surface/patches/height_patch.h"
#include "tests/support/kriging_by_lu.h"
#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

/// A surface over the plane: its height and slopes.
using Surface = Vector3d (*)(const Vector2d& place);

Vector3d sphere(const Vector2d& p) {
  const double height = std::sqrt(4.0 - p.squaredNorm());
  return {height - 2.0, -p.x() / height, -p.y() / height};
}

Vector3d waves(const Vector2d& p) {
  return {0.1 * std::sin(3.0 * p.x()) * std::cos(2.5 * p.y()),
          0.3 * std::cos(3.0 * p.x()) * std::cos(2.5 * p.y()),
          -0.25 * std::sin(3.0 * p.x()) * std::sin(2.5 * p.y())};
}

/// Steeper towards one side.
Vector3d swell(const Vector2d& p) {
  const double rise = 0.1 * std::exp(1.2 * p.x());
  return {rise * std::cos(1.5 * p.y()), 1.2 * rise * std::cos(1.5 * p.y()),
          -1.5 * rise * std::sin(1.5 * p.y())};
}

/// Ridges whose crests lie askew: no kernel that fits smooth surfaces goes with them.
Vector3d ridges(const Vector2d& p) {
  const auto ridge = [](double off) {
    const double cell = off - std::floor(off);
    return std::pair(std::min(cell, 1.0 - cell), cell < 0.5 ? 1.0 : -1.0);
  };
  const auto [one, way] = ridge(3.1 * p.x() + 1.3 * p.y() + 0.2);
  const auto [two, other] = ridge(-1.1 * p.x() + 2.7 * p.y() + 0.4);
  return {0.2 * (one + two), 0.2 * (3.1 * way - 1.1 * other), 0.2 * (1.3 * way + 2.7 * other)};
}

OrientedPoints points_on(Surface surface, std::size_t count, std::uint64_t seed, bool told = true) {
  auto points = test::disc_points(Vector3d::Zero(), Vector3d::UnitZ(), 1.0, count, 0.0, seed);
  for (auto& point : points) {
    const Vector3d here = surface(point.position.head<2>());
    point.position.z() = here[0];
    point.normal = Vector3d(-here[1], -here[2], 1.0).normalized();
    point.normal_told = told;
  }
  return points;
}

HeightPatch patch_of(const OrientedPoints& points) {
  return HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 0.05).value();
}

/// How far the patch is off the surface of that kernel through the points and their slopes, by as
/// exact ones as come nearest.
double off_solution(const HeightPatch& patch, const OrientedPoints& points, HeightKernel kernel) {
  const test::KrigingByLu model{kernel, kernel == HeightKernel::kSeptic ? 10 : 6};
  const auto count = static_cast<Eigen::Index>(points.size());
  HeightSamples samples{Eigen::Matrix2Xd(2, count), Eigen::VectorXd(count),
                        Eigen::VectorXd::Zero(count), Eigen::Matrix2Xd(2, count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& point = points[static_cast<std::size_t>(i)];
    samples.places.col(i) = point.position.head<2>();
    samples.heights[i] = point.position.z();
    samples.slopes.col(i) = -point.normal.head<2>() / point.normal.z();
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (double ratio = 1e-6; ratio < 2.0; ratio *= 10.0) {
    Eigen::VectorXd noise = Eigen::VectorXd::Constant(3 * count, ratio);
    noise.head(count).setZero();
    const Eigen::VectorXd solution = model.solution(samples, noise);
    double most = 0.0;
    for (const double x : {-0.5, -0.1, 0.3, 0.6}) {
      for (const double y : {-0.6, -0.2, 0.1, 0.4}) {
        const double height = model.beside(samples.places, {x, y}).dot(solution);
        most = std::max(most, std::abs(patch.at({x, y, height}).value));
      }
    }
    nearest = std::min(nearest, most);
  }
  return nearest;
}

struct Example {
  Surface surface;
  std::size_t points;
  HeightKernel kernel;
};
constexpr Example kExamples[] = {{ridges, 40, HeightKernel::kCubic},
                                 {waves, 12, HeightKernel::kQuintic},
                                 {sphere, 16, HeightKernel::kSeptic}};

TEST(HeightPatchSlopes, IsTheSurfaceThatLuDecompositionFinds) {
  for (const auto& [surface, count, right] : kExamples) {
    const auto points = points_on(surface, count, 1);
    const auto patch = patch_of(points);
    for (const auto kernel :
         {HeightKernel::kCubic, HeightKernel::kQuintic, HeightKernel::kSeptic}) {
      const double off = off_solution(patch, points, kernel);
      if (kernel == right) {
        EXPECT_LT(off, 1e-7) << power_of(kernel);
      } else {
        EXPECT_GT(off, 1e-6) << power_of(kernel) << ", not " << power_of(right);
      }
    }
  }
}

TEST(HeightPatchSlopes, GradientIsThatOfItsValue) {
  test::RandomNumbers random(2);
  for (const auto& [surface, count, kernel] : kExamples) {
    const auto patch = patch_of(points_on(surface, count, 1));
    const auto value = [&](const Vector3d& place) { return patch.at(place).value; };
    for (int i = 0; i < 20; ++i) {
      const Vector3d place(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6),
                           random.uniform(-0.2, 0.2));
      EXPECT_NEAR(
          (patch.at(place).gradient - test::slope_by_differences(value, place, 1e-5)).norm(), 0.0,
          1e-7)
          << power_of(kernel);
    }
  }
}

/// At each of them the slopes' kernels have no distance to divide by.
TEST(HeightPatchSlopes, PassesThroughExactPointsAsTheirNormalsSay) {
  for (const Surface surface : {sphere, waves, swell}) {
    const auto points = points_on(surface, 16, 3);
    const auto patch = patch_of(points);
    for (const auto& point : points) {
      EXPECT_NEAR(patch.at(point.position).value, 0.0, 1e-8);
      EXPECT_LT((patch.at(point.position).gradient.normalized() - point.normal).norm(), 1e-3);
    }
  }
}

/// Root mean square over the middle of the patch and ten draws. `wrong`: standard deviation of the
/// told slopes.
double error_on(Surface surface, std::size_t count, bool told, double wrong = 0.0) {
  double squares = 0.0;
  int places = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    auto points = points_on(surface, count, seed, told);
    test::RandomNumbers random(seed);
    for (auto& point : points) {
      point.normal += wrong * Vector3d(random.normal(), random.normal(), 0.0);
      point.normal.normalize();
    }
    const auto patch = patch_of(points);
    for (double x = -0.4; x <= 0.45; x += 0.1) {
      for (double y = -0.4; y <= 0.45; y += 0.1) {
        squares += std::pow(patch.at({x, y, surface({x, y})[0]}).value, 2);
        ++places;
      }
    }
  }
  return std::sqrt(squares / places);
}

TEST(HeightPatchSlopes, BringFewPointsSeveralTimesNearerToTheTruth) {
  for (const Surface surface : {sphere, waves, swell}) {
    for (const std::size_t count : {12U, 16U, 20U}) {
      EXPECT_LT(error_on(surface, count, true), 0.2 * error_on(surface, count, false)) << count;
    }
  }
}

/// How exact they are is told by how they go with the points: taken for exact, slopes that are off
/// would put the surface off by a twentieth of that.
TEST(HeightPatchSlopes, CountForLessTheWorseTheyGoWithThePoints) {
  for (const Surface surface : {sphere, waves, swell}) {
    const double bare = error_on(surface, 40, false);
    for (const double wrong : {0.01, 0.1, 1.0}) {
      EXPECT_LT(error_on(surface, 40, true, wrong), 3.0 * bare) << wrong;
    }
  }
}

TEST(HeightPatchSlopes, ASurfaceWandersLessBetweenPointsThatTellThem) {
  const std::vector<Vector3d> places = {{0.1, 0.2, 0.0}, {-0.3, 0.1, 0.0}};
  const Eigen::VectorXd shares = Eigen::Vector2d(1.0, 0.5);
  for (const Surface surface : {sphere, waves, swell}) {
    const auto told = patch_of(points_on(surface, 20, 4)).sums(places, shares);
    const auto bare = patch_of(points_on(surface, 20, 4, false)).sums(places, shares);
    EXPECT_EQ(told.influence.rows(), 20);
    EXPECT_GE(told.variance[0], 0.0);
    EXPECT_LT(told.variance[0], 0.25 * bare.variance[0]);
  }
}

/// The influence of a point's height on a sum, with the slopes as they are.
TEST(HeightPatchSlopes, InfluenceIsWhatMovingAPointDoesToTheSum) {
  const std::vector<Vector3d> places = {{0.1, 0.2, 0.0}, {-0.3, 0.1, 0.0}};
  const Eigen::VectorXd shares = Eigen::Vector2d(1.0, 0.5);
  auto points = points_on(ridges, 40, 1);
  const auto sum = [&] {
    const auto patch = patch_of(points);
    return -shares[0] * patch.at(places[0]).value - shares[1] * patch.at(places[1]).value;
  };
  const auto influence = patch_of(points).sums(places, shares).influence.col(0).eval();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double before = points[i].position.z();
    points[i].position.z() = before + 1e-6;
    const double more = sum();
    points[i].position.z() = before - 1e-6;
    EXPECT_NEAR((more - sum()) / 2e-6, influence[static_cast<Eigen::Index>(i)], 1e-6) << i;
    points[i].position.z() = before;
  }
}

/// Normals far off the truth, which would show.
OrientedPoints spoilt(OrientedPoints points, double variance, bool told) {
  test::RandomNumbers random(5);
  for (auto& point : points) {
    point.normal = Vector3d(0.5 * random.normal(), 0.5 * random.normal(), 1.0).normalized();
    point.variance = variance;
    point.normal_told = told;
  }
  return points;
}

double difference(const OrientedPoints& told, const OrientedPoints& bare) {
  const auto one = patch_of(told);
  const auto other = patch_of(bare);
  double most = 0.0;
  for (const double x : {-0.4, 0.0, 0.5}) {
    most = std::max(most, std::abs(one.at({x, 0.1, 0.0}).value - other.at({x, 0.1, 0.0}).value));
  }
  return most;
}

TEST(HeightPatchSlopes, OfNoisyPointsDoNotCount) {
  const auto points = points_on(waves, 30, 6);
  for (const double variance : {1e-4, 2e-5}) {
    EXPECT_EQ(difference(spoilt(points, variance, true), spoilt(points, variance, false)), 0.0);
  }
  for (const double harmless : {0.0, 1e-6}) {
    EXPECT_GT(difference(spoilt(points, harmless, true), spoilt(points, harmless, false)), 1e-4)
        << harmless << ": they would show";
  }
}

TEST(HeightPatchSlopes, DoNotCountUnlessAllPointsTellThem) {
  auto points = spoilt(points_on(waves, 30, 7), 0.0, true);
  points[11].normal_told = false;
  EXPECT_EQ(difference(points, spoilt(points, 0.0, false)), 0.0);
}

TEST(HeightPatchSlopes, OfPointsThatAreAveragedDoNotCount) {
  const auto points = points_on(waves, 200, 8);
  EXPECT_EQ(difference(spoilt(points, 0.0, true), spoilt(points, 0.0, false)), 0.0);
}

TEST(HeightPatchSlopes, AreTheSameInAnyUnitAndOrder) {
  const auto points = points_on(waves, 20, 9);
  const auto patch = patch_of(points);
  const auto other = patch_of(test::in_another_order(points, 10));
  const double factor = 1e3;
  const auto larger = HeightPatch::fit(test::scaled(points, factor), Vector3d::Zero(),
                                       Vector3d::UnitZ(), factor, 0.05 / factor)
                          .value();
  for (const double x : {-0.4, 0.0, 0.5}) {
    const Vector3d place(x, 0.1, 0.05);
    EXPECT_NEAR(other.at(place).value, patch.at(place).value, 1e-8);
    EXPECT_NEAR(larger.at(factor * place).value / factor, patch.at(place).value, 1e-7);
  }
}

}  // namespace
}  // namespace instep
