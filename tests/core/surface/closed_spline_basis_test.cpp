#include "core/surface/closed_spline_basis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace instep {
namespace {

double sum_of(const ClosedSplineBasis& basis, const Eigen::VectorXd& terms, double way) {
  const auto spot = basis.at(way);
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    sum += spot.values[i] * terms[spot.terms[static_cast<std::size_t>(i)]];
  }
  return sum;
}

TEST(ClosedSplineBasis, SharesOutOneEverywhere) {
  const ClosedSplineBasis basis(7.0, 5);
  for (double way = -10.0; way < 20.0; way += 0.37) {
    const auto spot = basis.at(way);
    EXPECT_NEAR(spot.values.sum(), 1.0, 1e-14);
    EXPECT_NEAR(spot.slopes.sum(), 0.0, 1e-14);
    EXPECT_GE(spot.values.minCoeff(), 0.0);
    EXPECT_LT(*std::max_element(spot.terms.begin(), spot.terms.end()), 5);
  }
}

TEST(ClosedSplineBasis, GoesRoundAgainAndIsSmoothWhereItCloses) {
  const ClosedSplineBasis basis(7.0, 9);
  Eigen::VectorXd terms(9);
  terms << 1, -2, 4, 0, 3, -1, 5, 2, -3;
  EXPECT_NEAR(sum_of(basis, terms, 2.3), sum_of(basis, terms, 2.3 + 7.0), 1e-13);
  EXPECT_NEAR(sum_of(basis, terms, 2.3), sum_of(basis, terms, 2.3 - 14.0), 1e-13);
  // Second differences across the joint are as small as a curve's.
  const double h = 1e-4;
  for (const double way : {0.0, 7.0, 7.0 / 9.0}) {
    const double before = sum_of(basis, terms, way - h) - sum_of(basis, terms, way - 2.0 * h);
    const double after = sum_of(basis, terms, way + h) - sum_of(basis, terms, way);
    EXPECT_NEAR(after / h, before / h, 0.02);
  }
}

TEST(ClosedSplineBasis, TellsItsSlope) {
  const ClosedSplineBasis basis(3.0, 6);
  Eigen::VectorXd terms(6);
  terms << 0, 1, 5, 2, -3, 1;
  for (double way = 0.05; way < 3.0; way += 0.31) {
    const auto spot = basis.at(way);
    double slope = 0.0;
    for (int i = 0; i < 4; ++i) {
      slope += spot.slopes[i] * terms[spot.terms[static_cast<std::size_t>(i)]];
    }
    const double h = 1e-6;
    EXPECT_NEAR(slope, (sum_of(basis, terms, way + h) - sum_of(basis, terms, way - h)) / (2.0 * h),
                1e-6);
  }
}

}  // namespace
}  // namespace instep
