// Girths of two cylinders side by side that touch, or nearly: the points hardly tell that they are
// two. Round both the tape would be 90 mm longer than round the larger one.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr double kRadius = 35.0;
constexpr double kOtherRadius = 25.0;
/// Of many intervals that hold in 95 % of cases.
constexpr double kThreeSigmas = 1.5;

/// What a tape gains where it takes a little of the other one with it, mm.
constexpr double kOfTheOther = 5.0;

PointCloud two_cylinders(std::size_t count, double apart_mm, double sigma_mm, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  const double middle = kRadius + apart_mm + kOtherRadius;
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_first = random.uniform(0.0, kRadius + kOtherRadius) < kRadius;
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double radius = (is_first ? kRadius : kOtherRadius) + sigma_mm * random.normal();
    cloud.positions.emplace_back((is_first ? 0.0 : middle) + radius * std::cos(angle),
                                 radius * std::sin(angle), random.uniform(-30.0, 30.0));
  }
  return cloud;
}

TEST(GirthOfTouchingBodies, IsOfTheLargerOneOrNotTold) {
  const double truth = 2.0 * std::numbers::pi * kRadius;
  int refused = 0;
  for (const double apart_mm : {0.5, 1.0, 2.0}) {
    for (const double sigma_mm : {0.2, 0.4}) {
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(testing::Message() << apart_mm << " " << sigma_mm << " " << seed);
        const auto girth =
            girth_by_rbf(two_cylinders(10000, apart_mm, sigma_mm, seed), test::level_plane(1.3));
        if (girth) {
          EXPECT_NEAR(girth->stretched_mm, truth,
                      kThreeSigmas * *girth->stretched_u95_mm + kOfTheOther);
        } else if (girth.error().message.find("pinched") != std::string::npos) {
          EXPECT_EQ(girth.error().code, ErrorCode::kInvalidInput);
          ++refused;
        }
      }
    }
  }
  EXPECT_GT(refused, 0);
}

/// Of the outline of an hourglass whose neck is so wide.
Eigen::Vector2d place_on_hourglass(double neck_mm, double angle) {
  const double least = 0.5 * neck_mm;
  const double radius = least + (45.0 - least) * 0.5 * (1.0 + std::cos(2.0 * angle));
  return radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

double tape_round_hourglass(double neck_mm) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < 20000; ++i) {
    corners.push_back(place_on_hourglass(neck_mm, 2.0 * std::numbers::pi * i / 20000));
  }
  return perimeter(convex_hull(std::move(corners)));
}

/// A body that the points plainly show to be one is told, however narrow its neck.
TEST(GirthOfAnHourglass, IsTold) {
  for (const double neck_mm : {10.0, 16.0}) {
    for (const double sigma_mm : {0.0, 0.2}) {
      SCOPED_TRACE(testing::Message() << neck_mm << " " << sigma_mm);
      test::RandomNumbers random(4);
      PointCloud cloud;
      for (int i = 0; i < 10000; ++i) {
        const auto place = place_on_hourglass(neck_mm, random.uniform(0.0, 2.0 * std::numbers::pi));
        const Eigen::Vector2d moved = place + sigma_mm * random.normal() * place.normalized();
        cloud.positions.emplace_back(moved.x(), moved.y(), random.uniform(-30.0, 30.0));
      }
      const auto girth = girth_by_rbf(cloud, test::level_plane(1.3));
      ASSERT_TRUE(girth) << girth.error().line();
      EXPECT_NEAR(girth->stretched_mm, tape_round_hourglass(neck_mm),
                  kThreeSigmas * *girth->stretched_u95_mm);
    }
  }
}

}  // namespace
}  // namespace instep
