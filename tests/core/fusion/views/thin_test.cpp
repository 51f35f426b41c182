#include "core/fusion/views/thin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/geometry/point_index.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Points on a sphere about the origin with noise along the normal, `views` of them taking turns.
ViewedCloud noisy_sphere(double radius, double sigma, double per_mm2, int views,
                         double view_bias = 0.0) {
  std::mt19937_64 random(21);
  std::normal_distribution<double> normal;
  ViewedCloud sphere;
  const int count = static_cast<int>(4 * std::numbers::pi * radius * radius * per_mm2);
  for (int i = 0; i < count; ++i) {
    const Vector3d out = Vector3d(normal(random), normal(random), normal(random)).normalized();
    const int view = i % views;
    const double bias = view_bias * (view % 2 == 0 ? 1 : -1);
    sphere.cloud.positions.push_back((radius + bias + sigma * normal(random)) * out);
    const Vector3d tilt(normal(random), normal(random), normal(random));
    sphere.cloud.normals.push_back((out + 0.05 * tilt).normalized());
    sphere.cloud.sigma_mm.push_back(sigma);
    sphere.cloud.view_directions.push_back(out);
    sphere.views.push_back(static_cast<std::uint16_t>(view));
  }
  return sphere;
}

struct Spread {
  double mean_radius = 0;
  double sd_of_z = 0;
};

Spread spread_of(const PointCloud& cloud, double radius) {
  Spread spread;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double height = cloud.positions[i].norm() - radius;
    spread.mean_radius += cloud.positions[i].norm();
    spread.sd_of_z += std::pow(height / cloud.sigma_mm[i], 2);
  }
  spread.mean_radius /= static_cast<double>(cloud.size());
  spread.sd_of_z = std::sqrt(spread.sd_of_z / static_cast<double>(cloud.size()));
  return spread;
}

TEST(Thin, KeepsTheRadiusOfASphere) {
  for (const double radius : {20.0, 40.0}) {
    for (const double spacing : {1.0, 2.0, 4.0}) {
      for (const double sigma : {0.02, 0.3}) {
        ThinSettings settings;
        settings.spacing_mm = spacing;
        const auto thinned = thin(noisy_sphere(radius, sigma, 3.0, 2), 2, settings).cloud;
        EXPECT_NEAR(spread_of(thinned, radius).mean_radius, radius, 0.05)
            << radius << " " << spacing << " " << sigma;
      }
    }
  }
}

TEST(Thin, KeepsSigmaHonest) {
  for (const double sigma : {0.1, 0.3, 0.8}) {
    for (const int views : {1, 3}) {
      const auto thinned =
          thin(noisy_sphere(40, sigma, 2.0, views), static_cast<std::size_t>(views), {}).cloud;
      const auto spread = spread_of(thinned, 40);
      EXPECT_GT(spread.sd_of_z, 0.7) << sigma << " " << views;
      EXPECT_LT(spread.sd_of_z, 1.4) << sigma << " " << views;
    }
  }
}

TEST(Thin, LowersSigmaByViewsButNotBelowTheSharedPartByPoints) {
  ThinSettings settings;
  settings.spacing_mm = 4.0;
  const auto mean_sigma = [](const PointCloud& cloud) {
    double sum = 0;
    for (const double sigma : cloud.sigma_mm) sum += sigma;
    return sum / static_cast<double>(cloud.size());
  };
  const double one = mean_sigma(thin(noisy_sphere(40, 0.3, 3.0, 1), 1, settings).cloud);
  const double four = mean_sigma(thin(noisy_sphere(40, 0.3, 3.0, 4), 4, settings).cloud);
  EXPECT_GE(one, settings.correlated_share * 0.3);
  EXPECT_LT(four, 0.7 * one);
}

TEST(Thin, SaysSoWhereViewsDisagree) {
  const auto agreeing = thin(noisy_sphere(40, 0.1, 3.0, 2), 2, {}).cloud;
  const auto biased = thin(noisy_sphere(40, 0.1, 3.0, 2, 0.4), 2, {}).cloud;
  EXPECT_GT(*std::max_element(biased.sigma_mm.begin(), biased.sigma_mm.end()),
            2.0 * *std::max_element(agreeing.sigma_mm.begin(), agreeing.sigma_mm.end()));
}

TEST(Thin, KeepsTheSpacingNeitherCloserNorMuchWider) {
  ThinSettings settings;
  settings.spacing_mm = 2.0;
  const auto thinned = thin(noisy_sphere(40, 0.05, 5.0, 1), 1, settings).cloud;
  const double area = 4 * std::numbers::pi * 40 * 40;
  EXPECT_LT(static_cast<double>(thinned.size()), area / (0.5 * 2.0 * 2.0));
  EXPECT_GT(static_cast<double>(thinned.size()), area / (2.0 * 2.0 * 2.0));
  EXPECT_TRUE(check_cloud(thinned));
}

TEST(Thin, KeepsTheTwoSidesOfAThinBodyApart) {
  ViewedCloud plate;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < 5000; ++i) {
      plate.cloud.positions.emplace_back(0.6 * (i % 100), 0.6 * (i / 100), 0.5 * side);
      plate.cloud.normals.push_back((side == 0 ? -1.0 : 1.0) * Vector3d::UnitZ());
      plate.cloud.sigma_mm.push_back(0.3);
      plate.cloud.view_directions.push_back(plate.cloud.normals.back());
      plate.views.push_back(0);
    }
  }
  for (const auto& point : thin(plate, 1, {}).cloud.positions) {
    EXPECT_TRUE(std::abs(point.z()) < 1e-9 || std::abs(point.z() - 0.5) < 1e-9);
  }
}

/// Where two views see as many points, the one with half the noise counts four times as much.
TEST(Thin, SaysHowMuchEachViewCounts) {
  auto sphere = noisy_sphere(40, 0.1, 5.0, 2);
  for (std::size_t i = 0; i < sphere.views.size(); ++i) {
    if (sphere.views[i] == 1) sphere.cloud.sigma_mm[i] = 0.2;
  }
  ThinSettings settings;
  settings.spacing_mm = 4.0;
  settings.correlated_share = 1.0;  // as many points of a view as may be count as one
  const auto thinned = thin(sphere, 3, settings);
  ASSERT_EQ(thinned.shares.rows(), 3) << "one that shows nothing of it too";
  ASSERT_EQ(thinned.shares.cols(), static_cast<Eigen::Index>(thinned.cloud.size()));
  for (Eigen::Index i = 0; i < thinned.shares.cols(); ++i) {
    EXPECT_NEAR(thinned.shares.col(i).sum(), 1.0, 1e-12);
  }
  EXPECT_NEAR(thinned.shares.row(0).mean(), 0.8, 0.02);
}

TEST(Thin, OfNothingIsNothing) {
  EXPECT_TRUE(thin({}, 0, {}).cloud.empty());
}

}  // namespace
}  // namespace instep
