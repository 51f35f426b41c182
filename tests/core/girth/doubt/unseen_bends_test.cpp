#include "core/girth/doubt/unseen_bends.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/degree.h"
#include "core/girth/contour/contour_index.h"
#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/circle_contour.h"

namespace instep {
namespace {

constexpr double kRadius = 0.35;
constexpr int kCorners = 3600;

/// Ten corners for each degree.
Contour circle(double radius = kRadius) {
  return test::circle_contour(radius, kCorners);
}

/// A point at each whole degree but between two of them, `first` < `second` < `first` + 360.
std::vector<double> ways_without(int first, int second) {
  const double degree = ContourIndex(circle()).length() / 360.0;
  std::vector<double> ways;
  for (int i = 0; i < 360; ++i) {
    const bool inside = (i > first && i < second) || (i + 360 > first && i + 360 < second);
    if (!inside) ways.push_back(i * degree);
  }
  return ways;
}

double doubt(int first, int second, double near = 0.05) {
  return unseen_bends_of(ContourCourse(circle()), ways_without(first, second), near).contact_u95;
}

/// Tangents at both ends meet in a corner.
double corner_less_arc(double degrees) {
  const double half = 0.5 * degrees * kDegree;
  return 2.0 * kRadius * (std::tan(half) - half);
}

TEST(UnseenBends, AreNoneWhereAllIsSeen) {
  EXPECT_EQ(doubt(10, 11), 0.0);
  EXPECT_EQ(unseen_bends_of(ContourCourse(circle()), {}, 0.05).contact_u95, 0.0);
}

TEST(UnseenBends, AreNoneWhereTheGapIsShortOrHardlyTurns) {
  EXPECT_EQ(doubt(100, 135), 0.0);
  EXPECT_GT(doubt(100, 140), 0.0);
  EXPECT_EQ(doubt(100, 140, 41.0 * kDegree * kRadius), 0.0);
}

TEST(UnseenBends, AreMoreThanWhatACornerWouldAddBeyondAnOrdinaryTurn) {
  for (const int degrees : {60, 90, 105}) {
    const double ordinary = corner_less_arc(36) * degrees / 36.0;
    const double longer = 1.2 * (corner_less_arc(degrees) - ordinary);
    EXPECT_NEAR(doubt(20, 20 + degrees, 0.0), longer, 1e-5) << degrees;
    const double gap = degrees * kDegree * kRadius;
    EXPECT_NEAR(doubt(20, 20 + degrees, 0.3 * gap), 0.7 * longer, 1e-5) << degrees;
  }
}

TEST(UnseenBends, AreTheSameWhereverTheContourBegins) {
  EXPECT_NEAR(doubt(300, 390), doubt(20, 110), 1e-9);
  EXPECT_NEAR(doubt(270, 360), doubt(20, 110), 1e-9);
}

TEST(UnseenBends, OfSeveralGapsAddUpAsIndependentOnes) {
  const double degree = ContourIndex(circle()).length() / 360.0;
  const std::vector<double> ways = {0.0, 90.0 * degree, 180.0 * degree, 270.0 * degree};
  EXPECT_NEAR(unseen_bends_of(ContourCourse(circle()), ways, 0.05).contact_u95,
              2.0 * doubt(20, 110), 1e-9);
}

TEST(UnseenBends, StayBoundedWhereAlmostNothingIsSeen) {
  const double all = unseen_bends_of(ContourCourse(circle()), {0.1}, 0.05).contact_u95;
  EXPECT_TRUE(std::isfinite(all));
  EXPECT_LT(all, 1.6 * ContourIndex(circle()).length());
}

/// The circle with a spike on it that is 0.2 high, of which no point tells.
TEST(UnseenBends, IncludeASpurThatNobodySaw) {
  Contour spiked = circle();
  for (int i = -5; i <= 5; ++i) {
    const auto corner = static_cast<std::size_t>(900 + i);
    spiked.points[corner] *= 1.0 + 0.2 * (1.0 - std::abs(i) / 5.0) / kRadius;
  }
  const double degree = ContourIndex(circle()).length() / 360.0;
  const double longer = ContourIndex(spiked).length() - ContourIndex(circle()).length();
  std::vector<double> ways;
  for (int i = 0; i < 360; ++i) ways.push_back(i * degree + (i > 90 ? longer : 0.0));
  std::erase_if(ways, [&](double way) { return std::abs(way - 90 * degree) < 0.5 * degree; });
  EXPECT_NEAR(unseen_bends_of(ContourCourse(spiked), ways, 0.05).contact_u95, longer, 0.02);
  EXPECT_NEAR(unseen_bends_of(ContourCourse(spiked), ways, 0.5).contact_u95, 0.0, 1e-12);
}

TEST(UnseenBends, AreTheSameInAnyUnit) {
  auto ways = ways_without(20, 110);
  for (auto& way : ways) way *= 1000.0;
  const double scaled =
      unseen_bends_of(ContourCourse(circle(1000.0 * kRadius)), ways, 50.0).contact_u95;
  EXPECT_NEAR(scaled, 1000.0 * doubt(20, 110), 1e-6);
}

/// A circle the other way round, with the body outside.
TEST(UnseenBends, InwardsAreNoneOfAStretchedTapes) {
  Contour inwards;
  for (auto& place : circle().outward) inwards.outward.push_back(-place);
  inwards.points = circle().points;
  std::reverse(inwards.points.begin(), inwards.points.end());
  std::reverse(inwards.outward.begin(), inwards.outward.end());
  const auto bends = unseen_bends_of(ContourCourse(inwards), ways_without(20, 110), 0.05);
  EXPECT_NEAR(bends.contact_u95, doubt(20, 110), 1e-9);
  EXPECT_EQ(bends.stretched_u95, 0.0);
  const auto outwards = unseen_bends_of(ContourCourse(circle()), ways_without(20, 110), 0.05);
  EXPECT_EQ(outwards.stretched_u95, outwards.contact_u95);
}

/// Exact points, but none within 12 mm of one edge of the sole.
TEST(UnseenBends, OfAnEdgeThatNobodySawAreToldByTheGirth) {
  const auto shape = test::flat_soled_cylinder(45, 35, 22);
  const Eigen::Vector2d edge(45.0 * std::sqrt(1.0 - std::pow(22.0 / 35.0, 2)), -22.0);
  const auto plane = TapePlane::through({0, 0, 0}, {10, 0, 1}, {0, 10, 2}).value();
  const double truth = test::true_girth(shape, plane);
  int told = 0;
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    PointCloud cloud = test::points_by_area(shape, 6000, -40, 40, seed);
    cloud.normals.clear();
    std::erase_if(cloud.positions, [&](const Eigen::Vector3d& place) {
      return (place.head<2>() - edge).norm() < 12.0;
    });
    const auto girth = girth_by_rbf(cloud, plane);
    if (!girth) continue;
    ++told;
    if (std::abs(girth->contact_mm - truth) <= *girth->contact_u95_mm) ++held;
    EXPECT_LT(*girth->contact_u95_mm, 5.0) << seed;
  }
  EXPECT_GE(told, 16);
  EXPECT_GE(10 * held, 8 * told) << "of " << told;
}

TEST(UnseenBends, AreNamedByTheGirth) {
  const auto thin = test::elliptic_cylinder(60, 10);
  PointCloud cloud = test::points_by_area(thin, 6000, -30, 30, 1);
  cloud.normals.clear();
  std::erase_if(cloud.positions, [](const Eigen::Vector3d& place) {
    return (place.head<2>() - Eigen::Vector2d(60.0, 0.0)).norm() < 14.0;
  });
  const auto plane = TapePlane::through({0, 0, 0}, {10, 0, 1}, {0, 10, 1}).value();
  const auto girth = girth_by_rbf(cloud, plane);
  ASSERT_TRUE(girth) << girth.error().line();
  const std::string said = fmt::format("{}", fmt::join(girth->warnings, "; "));
  EXPECT_NE(said.find("bend more sharply where no camera saw it"), std::string::npos) << said;
  EXPECT_EQ(said.find("so few or noisy"), std::string::npos) << said;
}

}  // namespace
}  // namespace instep
