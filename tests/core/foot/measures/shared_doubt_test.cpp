#include "core/foot/measures/shared_doubt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/analytic_shapes.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 45.0;
constexpr double kErrorMm = 0.3;
constexpr double kIn95 = 1.96;

/// An upright post in place of a foot, and a landmark on each side of it.
FootScan post() {
  FootScan foot;
  foot.cloud = test::points_by_area(test::elliptic_cylinder(kRadius, kRadius), 20000, -40, 40, 1);
  foot.landmarks["front"].position_mm = {kRadius, 0, 0};
  foot.landmarks["rear"].position_mm = {-kRadius, 0, 0};
  return foot;
}

/// Makes the post thicker all round, or shifts it.
std::vector<double> growth(const PointCloud& cloud) {
  return std::vector<double>(cloud.size(), kErrorMm);
}

std::vector<double> shift(const PointCloud& cloud) {
  std::vector<double> error;
  for (const auto& normal : cloud.normals) error.push_back(kErrorMm * normal.x());
  return error;
}

/// With what it borrows.
struct Doubt {
  explicit Doubt(const FootScan& foot) : seen(foot.cloud), shared(foot, seen) {}

  SeenSkin seen;
  SharedDoubt shared;
};

Result<double> length(const Landmarks& landmarks) {
  return landmarks.at("front").position_mm.x() - landmarks.at("rear").position_mm.x();
}

TEST(SharedDoubt, KnowsThatAShiftedBodyHasTheSameLengths) {
  FootScan foot = post();
  foot.cloud.shared_errors_mm = {shift(foot.cloud)};
  const Doubt doubt(foot);
  EXPECT_LT(doubt.shared.of(length), 0.02 * kErrorMm);
}

TEST(SharedDoubt, OfALengthIsThatOfItsEnds) {
  FootScan foot = post();
  foot.cloud.shared_errors_mm = {growth(foot.cloud)};
  const Doubt doubt(foot);
  EXPECT_NEAR(doubt.shared.of(length), kIn95 * 2.0 * kErrorMm, 0.01 * kErrorMm);
  const auto none = [](const Landmarks&) -> Result<double> {
    return fail(ErrorCode::kInsufficientData, "the landmark was not found", "scan again");
  };
  EXPECT_EQ(doubt.shared.of(none), 0.0);
}

/// What closes a sole knows of no errors, but hangs on the wall that does.
TEST(SharedDoubt, TakesUnseenSkinForAsWrongAsTheSeenBesideIt) {
  FootScan foot = post();
  foot.cloud.shared_errors_mm = {growth(foot.cloud)};
  PointCloud sole = foot.cloud;
  sole.shared_errors_mm.clear();
  sole.origins.assign(sole.size(), PointOrigin::kPlatform);
  foot.cloud.append(sole);
  const Doubt doubt(foot);
  EXPECT_NEAR(doubt.shared.of(length), kIn95 * 2.0 * kErrorMm, 0.01 * kErrorMm);
}

TEST(SharedDoubt, AddsIndependentErrorsAsSquares) {
  FootScan foot = post();
  foot.cloud.shared_errors_mm = {growth(foot.cloud), shift(foot.cloud), growth(foot.cloud)};
  const Doubt doubt(foot);
  EXPECT_NEAR(doubt.shared.of(length), std::sqrt(2.0) * kIn95 * 2.0 * kErrorMm, 0.01 * kErrorMm);
}

TEST(SharedDoubt, OfACloudThatKnowsOfNoneIsNone) {
  const FootScan foot = post();
  const Doubt doubt(foot);
  EXPECT_EQ(doubt.shared.of(length), 0.0);
}

}  // namespace
}  // namespace instep
