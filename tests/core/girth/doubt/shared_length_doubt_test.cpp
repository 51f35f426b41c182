#include "core/girth/doubt/shared_length_doubt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/smooth_field.h"

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

/// Errors that all points of a cloud share with their neighbours.
PointCloud erring(PointCloud cloud, double sigma_mm, double reach_mm) {
  cloud.local_errors = {std::vector<double>(cloud.size(), sigma_mm), reach_mm};
  return cloud;
}

using Line = std::vector<Eigen::Vector2d>;

std::vector<Eigen::Vector2d> outwards(const Line& line) {
  std::vector<Eigen::Vector2d> normals;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto& before = line[(i + line.size() - 1) % line.size()];
    const Eigen::Vector2d along = (line[(i + 1) % line.size()] - before).normalized();
    normals.emplace_back(along.y(), -along.x());
  }
  return normals;
}

/// Two corners err the less alike the further apart they lie and face.
Eigen::MatrixXd correlation(const Line& line, double reach_mm) {
  const auto normals = outwards(line);
  const auto count = static_cast<Eigen::Index>(line.size());
  Eigen::MatrixXd alike(count, count);
  for (std::size_t i = 0; i < line.size(); ++i) {
    for (std::size_t j = 0; j < line.size(); ++j) {
      const double apart = (line[i] - line[j]).norm() / reach_mm;
      alike(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          std::exp(-apart * apart) * 0.5 * (1.0 + normals[i].dot(normals[j]));
    }
  }
  return alike;
}

struct Longer {
  Eigen::VectorXd by;
  double mean = by.mean();
  double deviation = std::sqrt((by.array() - by.mean()).square().mean());

  double held_by(double half_width) const {
    return static_cast<double>((by.array().abs() <= half_width).count()) /
           static_cast<double>(by.size());
  }
};

/// By how much lines are longer whose corners lie off by errors at random.
struct ErringLines {
  Longer contact;
  Longer stretched;
};

ErringLines erring_lines(const Line& line, double sigma_mm, double reach_mm) {
  constexpr Eigen::Index kDraws = 2000;
  const auto normals = outwards(line);
  const Eigen::MatrixXd errors =
      sigma_mm * test::correlated_draws(correlation(line, reach_mm), kDraws, 1);
  Eigen::VectorXd contact(kDraws);
  Eigen::VectorXd stretched(kDraws);
  for (Eigen::Index draw = 0; draw < kDraws; ++draw) {
    Line moved = line;
    for (std::size_t i = 0; i < line.size(); ++i) {
      moved[i] += errors(static_cast<Eigen::Index>(i), draw) * normals[i];
    }
    contact(draw) = perimeter(moved) - perimeter(line);
    stretched(draw) = perimeter(convex_hull(moved)) - perimeter(line);
  }
  return {{contact}, {stretched}};
}

/// So small against their reach that lines are longer by where they lie, not by waves.
TEST(SharedLengthDoubt, OfLocalErrorsIsHowFarTheyScatterLengths) {
  constexpr int kCorners = 360;
  for (const auto& shape : {post(), test::elliptic_cylinder(60, 35)}) {
    const auto section = test::true_section(shape, leaning(0.0), kCorners);
    for (const double reach : {5.0, 15.0, 60.0}) {
      const double sigma = 0.002 * reach;
      const auto doubt =
          shared_doubt_of(section, leaning(0.0), erring(points_on(shape), sigma, reach));
      const auto truth = erring_lines(section, sigma, reach);
      const double contact = kIn95 * truth.contact.deviation;
      const double stretched = kIn95 * truth.stretched.deviation;
      EXPECT_NEAR(doubt.contact_u95, contact, 0.1 * contact) << reach;
      EXPECT_NEAR(doubt.stretched_u95, stretched, 0.1 * stretched) << reach;
    }
  }
}

/// On average over all pairs of places round a convex body two normals have nothing in common, so
/// that half the variance of a common growth is left.
TEST(SharedLengthDoubt, OfLocalErrorsOfAllSkinIsThatOfHalfAGrowth) {
  const double growth_u95 = kIn95 * 2.0 * std::numbers::pi * kErrorMm;
  for (const auto& shape : {post(), test::elliptic_cylinder(60, 35)}) {
    const auto section = test::true_section(shape, leaning(0.0), kRays);
    const auto doubt =
        shared_doubt_of(section, leaning(0.0), erring(points_on(shape), kErrorMm, 1e4));
    EXPECT_NEAR(doubt.contact_u95, growth_u95 / std::sqrt(2.0), 0.02 * growth_u95);
    EXPECT_NEAR(doubt.stretched_u95, growth_u95 / std::sqrt(2.0), 0.02 * growth_u95);
  }
}

/// Leaning planes cut skin aslant and go further by its errors. Of a common growth half the
/// variance is left: on average over all pairs of places round a body two normals have nothing in
/// common.
TEST(SharedLengthDoubt, OfLocalErrorsIsOfTheSkinAsThePlaneCutsIt) {
  const auto plane = leaning(40.0);
  const double longer = test::true_girth(post(kErrorMm), plane) - test::true_girth(post(), plane);
  const auto doubt = doubt_of_post(plane, erring(points_on(post()), kErrorMm, 300.0));
  EXPECT_NEAR(doubt.contact_u95, kIn95 * longer / std::sqrt(2.0), 0.02 * kIn95 * longer);
}

/// The two ends of a plate, round each of which a tape turns by half a turn, are too far apart to
/// err alike; of one end, where normals turn from one side to the other, (pi^2 + 4) / 2 is left of
/// the variance, and not pi^2, as if its two sides erred alike.
TEST(SharedLengthDoubt, KnowsThatTheSidesOfAThinPartErrApart) {
  constexpr double kHalfWidth = 60.0;
  constexpr double kHalfThickness = 8.0;
  const auto plate = test::elliptic_cylinder(kHalfWidth, kHalfThickness);
  const auto plane = *TapePlane::through({0, 0, 0}, {50, 0, 0}, {0, 50, 0});
  Line section;  // as many corners as it turns, which rays from its middle would not give
  for (int i = 0; i < kRays; ++i) {
    const double facing = 2.0 * std::numbers::pi * i / kRays;
    const Eigen::Vector2d arm(kHalfWidth * std::cos(facing), kHalfThickness * std::sin(facing));
    section.emplace_back(Eigen::Vector2d(kHalfWidth, kHalfThickness).cwiseProduct(arm) /
                         arm.norm());
  }
  const PointCloud cloud = erring(test::points_by_area(plate, 20000, -5, 5, 1), 0.01, 40.0);
  const double truth = kIn95 * 0.01 * std::sqrt(std::pow(std::numbers::pi, 2) + 4.0);
  EXPECT_NEAR(shared_doubt_of(section, plane, cloud).stretched_u95, truth, 0.06 * truth);
}

/// What is added to the half-width by waves, which grow with the square of the errors.
double by_waves(const Line& section, double sigma_mm, double reach_mm) {
  constexpr double kSmaller = 1e-3;
  const auto doubt_of = [&](double sigma) {
    return shared_doubt_of(section, leaning(0.0), erring(points_on(post()), sigma, reach_mm))
        .contact_u95;
  };
  const double by_place = doubt_of(kSmaller * sigma_mm) / kSmaller;
  return doubt_of(sigma_mm) - by_place;
}

TEST(SharedLengthDoubt, CountsTheWavesThatALineFollows) {
  const auto section = test::true_section(post(), leaning(0.0), 400);
  for (const double sigma : {0.4, 0.8}) {
    const auto truth = erring_lines(section, sigma, 8.0);
    EXPECT_NEAR(by_waves(section, sigma, 8.0), truth.contact.mean, 0.1 * truth.contact.mean);
  }
}

/// Whichever it follows, the tape or each wave.
TEST(SharedLengthDoubt, HoldsNineteenOfTwentyLinesThatErrLocally) {
  const auto section = test::true_section(post(), leaning(0.0), 400);
  for (const double sigma : {0.1, 0.2, 0.4, 0.8}) {
    const auto doubt =
        shared_doubt_of(section, leaning(0.0), erring(points_on(post()), sigma, 8.0));
    const auto truth = erring_lines(section, sigma, 8.0);
    EXPECT_GT(truth.contact.held_by(doubt.contact_u95), 0.935) << sigma;
    EXPECT_GT(truth.stretched.held_by(doubt.stretched_u95), 0.935) << sigma;
  }
}

TEST(SharedLengthDoubt, AddsLocalErrorsToSharedOnesAsSquares) {
  PointCloud cloud = erring(points_on(post()), kErrorMm, 60.0);
  const double local = doubt_of_post(leaning(0.0), cloud).stretched_u95;
  add_error(cloud, growth);
  const double shared = kIn95 * 2.0 * std::numbers::pi * kErrorMm;
  EXPECT_NEAR(doubt_of_post(leaning(0.0), cloud).stretched_u95, std::hypot(local, shared),
              0.01 * shared);
}

TEST(SharedLengthDoubt, TakesUnseenSkinForAsLocallyWrongAsTheSeenBesideIt) {
  PointCloud cloud = points_on(post());
  PointCloud sole = cloud;
  cloud = erring(std::move(cloud), kErrorMm, 15.0);
  const auto all_seen = doubt_of_post(leaning(0.0), cloud);
  sole.origins.assign(sole.size(), PointOrigin::kPlatform);
  cloud.append(sole);
  const auto doubt = doubt_of_post(leaning(0.0), cloud);
  EXPECT_GT(doubt.contact_u95, kErrorMm);
  EXPECT_NEAR(doubt.stretched_u95, all_seen.stretched_u95, 1e-9);
  EXPECT_NEAR(doubt.contact_u95, all_seen.contact_u95, 1e-9);
}

}  // namespace
}  // namespace instep
