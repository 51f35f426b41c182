#include "core/girth/shared_length_doubt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::AnalyticShape;

constexpr double kRadius = 45.0;
constexpr double kErrorMm = 0.3;
constexpr double kIn95 = 1.96;
constexpr int kRays = 720;

AnalyticShape post(double thicker_mm = 0.0) {
  return test::elliptic_cylinder(kRadius + thicker_mm, kRadius + thicker_mm);
}

PointCloud points_on(const AnalyticShape& shape) {
  return test::points_by_area(shape, 20000, -40, 40, 1);
}

/// An error of each point, by where it is and where its skin faces.
using Error = std::function<double(const Vector3d& position, const Vector3d& normal)>;

void add_error(PointCloud& cloud, const Error& error) {
  cloud.shared_errors_mm.emplace_back();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.shared_errors_mm.back().push_back(error(cloud.positions[i], cloud.normals[i]));
  }
}

double growth(const Vector3d&, const Vector3d&) {
  return kErrorMm;
}

double shift(const Vector3d&, const Vector3d& normal) {
  return kErrorMm * normal.x();
}

TapePlane leaning(double degrees) {
  const double lean = degrees * std::numbers::pi / 180.0;
  return *TapePlane::through({0, 0, 0}, {0, 50, 0}, {std::cos(lean) * 50, 0, std::sin(lean) * 50});
}

SharedLengthDoubt doubt_of_post(const TapePlane& plane, const PointCloud& cloud) {
  return shared_doubt_of(test::true_section(post(), plane, kRays), plane, cloud);
}

TEST(SharedLengthDoubt, IsWhatAThickerBodyMeasuresMore) {
  PointCloud cloud = points_on(post());
  add_error(cloud, growth);
  for (const double degrees : {0.0, 20.0, 40.0}) {
    const auto plane = leaning(degrees);
    const double longer = test::true_girth(post(kErrorMm), plane) - test::true_girth(post(), plane);
    const auto doubt = doubt_of_post(plane, cloud);
    EXPECT_NEAR(doubt.stretched_u95, kIn95 * longer, 0.02 * longer) << degrees;
    EXPECT_NEAR(doubt.contact_u95, kIn95 * longer, 0.02 * longer) << degrees;
  }
}

TEST(SharedLengthDoubt, KnowsThatAShiftedBodyHasTheSameLengths) {
  PointCloud cloud = points_on(post());
  add_error(cloud, shift);
  const auto doubt = doubt_of_post(leaning(0.0), cloud);
  EXPECT_LT(doubt.stretched_u95, 0.02 * kErrorMm);
  EXPECT_LT(doubt.contact_u95, 0.02 * kErrorMm);
}

/// The truth: the lengths of the section that the error has moved.
TEST(SharedLengthDoubt, OfHollowsIsOfTheSkinAloneNotOfTheTapeOverThem) {
  constexpr double kDepthMm = 8.0;
  const auto lobed = test::lobed_cylinder(kRadius, kDepthMm, 3);
  PointCloud cloud = points_on(lobed);
  const auto swelling = [](const Vector3d& position, const Vector3d&) {
    const double radius = position.head<2>().norm();
    return radius < kRadius ? 0.01 * std::pow(1.0 - (radius - kRadius) / kDepthMm, 2) - 0.01 : 0.0;
  };
  add_error(cloud, swelling);
  const auto section = test::true_section(lobed, leaning(0.0), kRays);
  auto swollen = section;
  for (std::size_t i = 0; i < swollen.size(); ++i) {
    const auto& before = section[(i + swollen.size() - 1) % swollen.size()];
    const Eigen::Vector2d along = (section[(i + 1) % swollen.size()] - before).normalized();
    const Vector3d corner(section[i].x(), section[i].y(), 0.0);
    swollen[i] += swelling(corner, corner) * Eigen::Vector2d(along.y(), -along.x());
  }
  const double longer = std::abs(perimeter(swollen) - perimeter(section));
  ASSERT_GT(longer, 0.01);
  const auto doubt = shared_doubt_of(section, leaning(0.0), cloud);
  EXPECT_NEAR(doubt.contact_u95, kIn95 * longer, 0.1 * longer);
  EXPECT_LT(doubt.stretched_u95, 0.1 * doubt.contact_u95);
}

/// What closes a sole knows of no errors, but hangs on the wall that does.
TEST(SharedLengthDoubt, TakesUnseenSkinForAsWrongAsTheSeenBesideIt) {
  PointCloud cloud = points_on(post());
  PointCloud sole = cloud;
  add_error(cloud, growth);
  const auto all_seen = doubt_of_post(leaning(0.0), cloud);
  sole.origins.assign(sole.size(), PointOrigin::kPlatform);
  cloud.append(sole);
  const auto doubt = doubt_of_post(leaning(0.0), cloud);
  EXPECT_NEAR(doubt.stretched_u95, all_seen.stretched_u95, 1e-9);
  EXPECT_NEAR(doubt.contact_u95, all_seen.contact_u95, 1e-9);
}

TEST(SharedLengthDoubt, AddsIndependentErrorsAsSquares) {
  PointCloud cloud = points_on(post());
  for (const Error& error : {Error(growth), Error(shift), Error(growth)}) add_error(cloud, error);
  const double one = kIn95 * 2.0 * std::numbers::pi * kErrorMm;
  EXPECT_NEAR(doubt_of_post(leaning(0.0), cloud).stretched_u95, std::sqrt(2.0) * one, 0.01 * one);
}

TEST(SharedLengthDoubt, OfACloudThatKnowsOfNoneIsNone) {
  const auto doubt = doubt_of_post(leaning(0.0), points_on(post()));
  EXPECT_EQ(doubt.stretched_u95, 0.0);
  EXPECT_EQ(doubt.contact_u95, 0.0);
}

/// Rings, half-way between two of which the plane lies.
TEST(SharedLengthDoubt, IsThatOfTheNearestSkinHoweverFar) {
  PointCloud cloud = points_on(post());
  std::vector<std::size_t> far;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (std::abs(cloud.positions[i].z()) > 10.0) far.push_back(i);
  }
  cloud = cloud.subset(far);
  add_error(cloud, growth);
  const double one = kIn95 * 2.0 * std::numbers::pi * kErrorMm;
  EXPECT_NEAR(doubt_of_post(leaning(0.0), cloud).stretched_u95, one, 0.02 * one);
}

TEST(SharedLengthDoubt, RefusesAGirthOfWhichItLeavesNothing) {
  PointCloud cloud = points_on(post());
  add_error(cloud, [](const Vector3d&, const Vector3d&) { return 5.0; });
  const auto refused = girth_by_rbf(cloud, leaning(0.0));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInsufficientData);
  EXPECT_NE(refused.error().advice.find("calibrate"), std::string::npos);
  cloud.shared_errors_mm.clear();
  add_error(cloud, [](const Vector3d&, const Vector3d&) { return 1.0; });
  const auto told = girth_by_rbf(cloud, leaning(0.0));
  ASSERT_TRUE(told) << told.error().line();
  ASSERT_EQ(told->warnings.size(), 1U);
  EXPECT_NE(told->warnings[0].find("errors that the points share"), std::string::npos);
}

TEST(SharedLengthDoubt, IsInTheIntervalOfAGirth) {
  PointCloud cloud = points_on(post());
  const auto alone = girth_by_rbf(cloud, leaning(0.0));
  ASSERT_TRUE(alone) << alone.error().line();
  add_error(cloud, growth);
  const auto girth = girth_by_rbf(cloud, leaning(0.0));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_EQ(girth->stretched_mm, alone->stretched_mm);
  const double shared = kIn95 * 2.0 * std::numbers::pi * kErrorMm;
  EXPECT_NEAR(*girth->stretched_u95_mm, std::hypot(*alone->stretched_u95_mm, shared), 0.01);
  EXPECT_NEAR(*girth->contact_u95_mm, std::hypot(*alone->contact_u95_mm, shared), 0.01);
}

}  // namespace
}  // namespace instep
