#include "core/surface/heights/height_samples.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

HeightSamples random_samples(Eigen::Index count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  HeightSamples samples;
  samples.places.resize(2, count);
  samples.heights.resize(count);
  samples.variances.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    samples.places.col(i) << random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7);
    samples.heights[i] = random.normal();
    samples.variances[i] = 1.0;
  }
  return samples;
}

double quadratic_at(const Quadratic& c, const Eigen::Vector2d& p) {
  return c[0] + c[1] * p.x() + c[2] * p.y() + c[3] * p.x() * p.x() + c[4] * p.x() * p.y() +
         c[5] * p.y() * p.y();
}

Quadratic some_quadratic() {
  Quadratic quadratic;
  quadratic << 0.3, -0.2, 0.5, 0.7, -0.4, 0.1;
  return quadratic;
}

TEST(HeightSamples, AreThePointsInThePatchsOwnCoordinates) {
  const Vector3d centre(10, -20, 30);
  const double radius = 4.0;
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(0.8, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Vector3d over = axes.row(2).transpose();
  const auto points = test::disc_points(centre + 0.5 * over, over, radius, 50, 0.2, 1);
  const auto samples = samples_over(points, HeightBase(axes, centre, radius));
  ASSERT_EQ(samples.size(), 50);
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    const auto& point = points[static_cast<std::size_t>(i)];
    const Vector3d local(samples.places(0, i), samples.places(1, i), samples.heights[i]);
    EXPECT_NEAR((centre + radius * axes.transpose() * local - point.position).norm(), 0.0, 1e-12);
    EXPECT_NEAR(samples.variances[i], point.variance / (radius * radius), 1e-15);
    EXPECT_LE(samples.places.col(i).norm(), 1.0 + 1e-12);
  }
}

std::vector<OrientedPoint> told_plane(const Vector3d& normal, std::size_t count) {
  auto points = test::disc_points({1, 2, 3}, normal, 2.0, count, 0.0, 4);
  for (auto& point : points) point.normal_told = true;
  return points;
}

const Eigen::Matrix3d kAskew =
    Eigen::AngleAxisd(0.8, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();

/// From one place of a plane to another, its height rises by the slope times the way.
TEST(HeightSamples, SlopesAreThoseOfTheSurfaceThatNormalsTell) {
  const Vector3d normal =
      kAskew.transpose() * Vector3d(0.3, -0.5, 0.9).normalized();  // seen from the patch
  const auto samples = samples_over(told_plane(normal, 20), HeightBase(kAskew, {1, 2, 3}, 2.0));
  ASSERT_TRUE(samples.has_slopes());
  for (Eigen::Index i = 1; i < samples.size(); ++i) {
    const Eigen::Vector2d way = samples.places.col(i) - samples.places.col(0);
    EXPECT_NEAR(samples.slopes.col(i).dot(way), samples.heights[i] - samples.heights[0], 1e-12);
  }
}

TEST(HeightSamples, HaveSlopesIfAllNormalsAreToldAndThePointsAreFew) {
  const HeightBase base(Eigen::Matrix3d::Identity(), Vector3d::Zero(), 1.0);
  const auto have_slopes = [&](const std::vector<OrientedPoint>& points) {
    return samples_over(points, base).has_slopes();
  };
  EXPECT_TRUE(have_slopes(told_plane(Vector3d::UnitZ(), 64)));
  EXPECT_FALSE(have_slopes(told_plane(Vector3d::UnitZ(), 65)));
  auto points = told_plane(Vector3d::UnitZ(), 20);
  points[13].normal_told = false;
  EXPECT_FALSE(have_slopes(points));
}

/// A normal along the plane or away from it has no slope over it, and must not count for much.
TEST(HeightSamples, SteepSlopesAreFlattened) {
  const HeightBase base(Eigen::Matrix3d::Identity(), Vector3d::Zero(), 1.0);
  for (const double height : {0.2, 0.01, 0.0, -0.7, -1.0}) {
    auto points = told_plane(Vector3d::UnitZ(), 10);
    points[3].normal = Vector3d(std::sqrt(1.0 - height * height), 0.0, height);
    const Eigen::Vector2d slope = samples_over(points, base).slopes.col(3);
    EXPECT_LE(slope.norm(), 4.0) << height;
    EXPECT_LE(slope.x(), 0.0) << height;
  }
}

TEST(HeightSamples, MonomialsAreThoseOfTheCubicTheQuadraticOrThePlane) {
  const auto samples = random_samples(20, 2);
  const auto six = monomials(samples.places, 6);
  const auto three = monomials(samples.places, 3);
  const auto ten = monomials(samples.places, 10);
  ASSERT_EQ(six.rows(), 20);
  ASSERT_EQ(six.cols(), 6);
  ASSERT_EQ(three.cols(), 3);
  for (Eigen::Index i = 0; i < 20; ++i) {
    EXPECT_NEAR(six.row(i).dot(some_quadratic()),
                quadratic_at(some_quadratic(), samples.places.col(i)), 1e-15);
    EXPECT_EQ(three.row(i), six.row(i).head(3));
    EXPECT_EQ(six.row(i), ten.row(i).head(6));
    const double x = samples.places(0, i);
    const double y = samples.places(1, i);
    EXPECT_NEAR(ten.row(i).tail(4).dot(Eigen::Vector4d(1.0, 3.0, 3.0, 1.0)), std::pow(x + y, 3),
                1e-15);
    EXPECT_NEAR(ten.row(i).tail(4).dot(Eigen::Vector4d(1.0, -6.0, 12.0, -8.0)),
                std::pow(x - 2.0 * y, 3), 1e-14);
  }
}

TEST(HeightSamples, LeastSquaresFindsAnExactQuadratic) {
  for (const Eigen::Index count : {6, 7, 200}) {
    auto samples = random_samples(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
      samples.heights[i] = quadratic_at(some_quadratic(), samples.places.col(i));
    }
    EXPECT_NEAR((least_squares(samples) - some_quadratic()).norm(), 0.0, 1e-9) << count;
  }
}

TEST(HeightSamples, LeastSquaresCannotBeBetteredByAnyStep) {
  const auto samples = random_samples(80, 4);
  const auto squares = [&](const Quadratic& quadratic) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < samples.size(); ++i) {
      sum += std::pow(samples.heights[i] - quadratic_at(quadratic, samples.places.col(i)), 2);
    }
    return sum;
  };
  const Quadratic best = least_squares(samples);
  for (Eigen::Index term = 0; term < 6; ++term) {
    for (const double step : {-1e-3, 1e-3}) {
      Quadratic other = best;
      other[term] += step;
      EXPECT_GT(squares(other), squares(best)) << "term " << term;
    }
  }
}

/// Nine places further apart than any of 64 cells over the neighbourhood is wide, each with many
/// samples of unlike certainty.
TEST(HeightSamples, ACellIsTheMeanOfItsSamplesWeightedByCertainty) {
  constexpr Eigen::Index each = 20;
  auto samples = random_samples(9 * each, 5);
  test::RandomNumbers random(6);
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < 9; ++i) places.emplace_back(0.61 * (i % 3 - 1), 0.61 * (i / 3 - 1));
  std::vector<double> certainty(9, 0.0);
  std::vector<double> mean(9, 0.0);
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    const auto cell = static_cast<std::size_t>(i % 9);
    samples.places.col(i) = places[cell];
    samples.variances[i] = random.uniform(0.1, 5.0);
    const double rest = samples.heights[i] - quadratic_at(some_quadratic(), places[cell]);
    certainty[cell] += 1.0 / samples.variances[i];
    mean[cell] += rest / samples.variances[i];
  }
  const auto cells = averaged_rest(samples, some_quadratic()).samples;
  ASSERT_EQ(cells.size(), 9);
  for (std::size_t cell = 0; cell < 9; ++cell) {
    Eigen::Index found = 0;
    const double off = (cells.places.colwise() - places[cell]).colwise().norm().minCoeff(&found);
    EXPECT_NEAR(off, 0.0, 1e-12);
    EXPECT_NEAR(cells.heights[found], mean[cell] / certainty[cell], 1e-12);
    EXPECT_NEAR(cells.variances[found], 1.0 / certainty[cell], 1e-12);
  }
}

TEST(HeightSamples, AveragingKeepsAllCertaintyAndTheMeanInAtMost64Cells) {
  for (const Eigen::Index count : {61, 500, 5000}) {
    auto samples = random_samples(count, 7);
    test::RandomNumbers random(8);
    for (auto& variance : samples.variances) variance = random.uniform(0.5, 2.0);
    const auto cells = averaged_rest(samples, Quadratic::Zero()).samples;
    EXPECT_LE(cells.size(), 64);
    EXPECT_GE(cells.size(), 20);
    const Eigen::VectorXd before = samples.variances.cwiseInverse();
    const Eigen::VectorXd after = cells.variances.cwiseInverse();
    EXPECT_NEAR(after.sum(), before.sum(), 1e-9 * before.sum());
    EXPECT_NEAR(after.dot(cells.heights), before.dot(samples.heights), 1e-9 * before.sum());
    EXPECT_NEAR((cells.places * after - samples.places * before).norm(), 0.0, 1e-9 * before.sum());
  }
}

TEST(HeightSamples, NothingIsLeftOverAQuadraticSurface) {
  auto samples = random_samples(2000, 9);
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    samples.heights[i] = quadratic_at(some_quadratic(), samples.places.col(i));
  }
  EXPECT_NEAR(averaged_rest(samples, some_quadratic()).samples.heights.norm(), 0.0, 1e-12);
  EXPECT_GT(averaged_rest(samples, Quadratic::Zero()).samples.heights.norm(), 0.5);
}

/// A dozen in two rows `apart`, turned by an angle, on a tilted plane but for rounding.
HeightSamples samples_in_rows(double apart, double angle, double rounding) {
  HeightSamples samples = random_samples(12, 1);
  const Eigen::Rotation2Dd turn(angle);
  test::RandomNumbers random(2);
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    const double along = 0.1 * static_cast<double>(i % 6) - 0.25;
    const double across = (i < 6 ? -0.5 : 0.5) * apart;
    samples.places.col(i) = turn * Eigen::Vector2d(along, across);
    samples.heights[i] = 0.2 + 0.3 * along + 0.4 * across + rounding * random.normal();
  }
  return samples;
}

/// What lies between two rows, or beside one, no sample tells: rounding must not.
TEST(LeastSquares, AreFlatWhereRowsLeaveItOpen) {
  for (const double angle : {0.0, 0.3, 0.8, 1.5707963267948966, 2.0}) {
    const Eigen::Rotation2Dd turn(angle);
    for (const double rounding : {0.0, 1e-16, 1e-13}) {
      const auto between = least_squares(samples_in_rows(0.6, angle, rounding));
      EXPECT_NEAR(quadratic_at(between, turn * Eigen::Vector2d(0.0, 0.0)), 0.2, 1e-6) << angle;
      EXPECT_NEAR(quadratic_at(between, turn * Eigen::Vector2d(0.1, 0.9)), 0.59, 1e-6) << angle;
      const auto beside = least_squares(samples_in_rows(0.0, angle, rounding));
      EXPECT_NEAR(quadratic_at(beside, turn * Eigen::Vector2d(0.2, 0.7)), 0.26, 1e-6) << angle;
    }
  }
}

}  // namespace
}  // namespace instep
