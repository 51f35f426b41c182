#include "core/girth/section/smooth_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"

namespace instep {
namespace {

struct Trials {
  double rms_mm = 0.0;
  double held = 0.0;  ///< share of the intervals
};

Trials trials(const test::AnalyticShape& shape, const TapePlane& plane, std::size_t points,
              double sigma_mm) {
  constexpr int kDraws = 24;
  const double truth = test::true_girth(shape, plane);
  Trials sum;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto cloud = test::random_points(shape, points, -30, 30, sigma_mm,
                                           500 + static_cast<std::uint64_t>(draw));
    const auto girth = girth_by_rbf(cloud, plane);
    EXPECT_TRUE(girth) << girth.error().line();
    if (!girth) continue;
    const double error = girth->contact_mm - truth;
    sum.rms_mm += error * error / kDraws;
    sum.held += (std::abs(error) <= girth->contact_u95_mm.value_or(0.0)) / double{kDraws};
  }
  sum.rms_mm = std::sqrt(sum.rms_mm);
  return sum;
}

/// What white noise leaves of a fit over points up to `width` beside the plane, by the measured
/// rule: sigma * 1.5 * sqrt(K2 / (2 rho width)), K2 the integral of the squared curvature.
double floor_mm(double radius, double per_area, double sigma_mm, double width) {
  const double bend = 2.0 * std::numbers::pi / radius;
  return sigma_mm * 1.5 * std::sqrt(bend / (2.0 * per_area * width));
}

TEST(SmoothSection, LeavesOfNoiseWhatAMeanLeaves) {
  const double area = test::kCylinderGirth * 60.0;
  for (const double sigma : {0.2, 0.5, 1.0}) {
    const auto seen = trials(test::elliptic_cylinder(40.0, 40.0), test::level_plane(), 8000, sigma);
    // 24 draws tell a standard deviation to 15 %.
    EXPECT_LT(seen.rms_mm, 1.3 * floor_mm(40.0, 8000 / area, sigma, 20.0)) << sigma;
    EXPECT_GE(seen.held, 0.85) << sigma;
  }
}

TEST(SmoothSection, HoldsOnShapesThatChangeAlongTheBody) {
  const auto oblique = test::oblique_plane();
  for (const auto& shape :
       {test::cone(38.0, 0.4), test::ellipsoid(48.0, 36.0, 70.0), test::bent_tube(150.0, 36.0)}) {
    const auto seen = trials(shape, test::level_plane(), 6000, 0.5);
    EXPECT_LT(seen.rms_mm, 0.15);
    EXPECT_GE(seen.held, 0.85);
  }
  const auto seen = trials(test::elliptic_cylinder(45.0, 30.0), oblique, 6000, 0.5);
  EXPECT_LT(seen.rms_mm, 0.15);
  EXPECT_GE(seen.held, 0.85);
}

/// A spline would round the creases off: about -1 mm.
TEST(SmoothSection, LeavesCreasesToThePatches) {
  const auto seen =
      trials(test::flat_soled_cylinder(45.0, 32.0, 18.0), test::level_plane(), 5000, 0.4);
  EXPECT_LT(seen.rms_mm, 0.5);
  EXPECT_GE(seen.held, 0.85);
}

/// A polynomial across the ribbon levels a bead round the body: in one draw of twelve the spline's
/// girth was 6 mm short, with an interval of 0.2 mm.
TEST(SmoothSection, LeavesANarrowBeadToThePatches) {
  const auto radius = [](double height) {
    return 40.0 + 2.0 * std::exp(-std::pow((height - 1.3) / 3.0, 2) / 2.0);
  };
  const test::AnalyticShape beaded{
      [=](double angle, double height) {
        const double there = radius(height);
        return Eigen::Vector3d(there * std::cos(angle), there * std::sin(angle), height);
      },
      [=](const Eigen::Vector3d& place) { return place.head<2>().norm() - radius(place.z()); }};
  const auto seen = trials(beaded, test::level_plane(), 8000, 0.5);
  EXPECT_LT(seen.rms_mm, 1.0);
  EXPECT_GE(seen.held, 0.95);
}

/// The spline's own intervals held in half of such draws.
TEST(SmoothSection, DoubtsWhatNobodySaw) {
  const auto shape = test::elliptic_cylinder(45.0, 35.0);
  const double truth = test::true_girth(shape, test::level_plane());
  int held = 0;
  for (std::uint64_t draw = 0; draw < 12; ++draw) {
    auto cloud = test::random_points(shape, 8000, -30, 30, 0.5, 500 + draw);
    std::erase_if(cloud.positions, [](const Eigen::Vector3d& place) {
      const double way = 40.0 * std::atan2(place.y() / 35.0, place.x() / 45.0);
      return std::abs(way) < 15.0 && std::abs(place.z() - 1.0) < 15.0;
    });
    const auto girth = girth_by_rbf(cloud, test::level_plane());
    ASSERT_TRUE(girth) << girth.error().line();
    held += std::abs(girth->contact_mm - truth) <= girth->contact_u95_mm.value_or(0.0);
  }
  EXPECT_GE(held, 10);
}

/// The section of a cylinder in the unit of its band, told by a few hundred corners.
Contour circle_in(const PlaneBand& band) {
  Contour contour;
  for (int i = 0; i < 300; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 300;
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    contour.points.emplace_back((test::kCylinderRadius * out - band.middle_mm) / band.unit_mm);
    contour.outward.push_back(out);
  }
  return contour;
}

TEST(SmoothSection, IsForNoisyPoints) {
  const auto plane = test::plane_at({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
  const auto section = [&](double sigma_mm) {
    const auto cloud = test::cylinder(6000, sigma_mm);
    SlabSource slabs(cloud, plane);
    const auto band = band_at(slabs);
    EXPECT_TRUE(band);
    return smooth_section(slabs, *band, circle_in(*band), false);
  };
  EXPECT_TRUE(section(0.3));
  EXPECT_FALSE(section(0.0));
}

TEST(SmoothSection, BelievesPointsByTheirOwnSigma) {
  auto cloud = test::cylinder(3000, 0.2, 11);
  const auto wild = test::cylinder(3000, 2.0, 12);
  cloud.sigma_mm.assign(cloud.size(), 0.2);
  cloud.positions.insert(cloud.positions.end(), wild.positions.begin(), wild.positions.end());
  cloud.sigma_mm.resize(cloud.size(), 2.0);
  const auto girth = girth_by_rbf(cloud, test::level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, test::kCylinderGirth, 0.15);
}

}  // namespace
}  // namespace instep
