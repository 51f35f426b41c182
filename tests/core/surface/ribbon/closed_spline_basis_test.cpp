#include "core/surface/ribbon/closed_spline_basis.h"

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

TEST(ClosedSplineBasis, IsCubicFromKnotToKnot) {
  const ClosedSplineBasis basis(7.0, 5);
  for (double way = -10.0; way < 20.0; way += 0.37) {
    const auto [knot, part] = basis.place_of(way);
    const double turned = (static_cast<double>(knot) + part) * basis.knots_apart();
    EXPECT_NEAR(std::remainder(turned - way, 7.0), 0.0, 1e-12);
    EXPECT_GE(part, 0.0);
    EXPECT_LE(part, 1.0);
    const Eigen::Vector4d powers(1.0, part, part * part, part * part * part);
    const auto spot = basis.at(way);
    EXPECT_EQ(spot.terms, basis.terms_from(knot));
    EXPECT_LT((ClosedSplineBasis::polynomials() * powers - spot.values).norm(), 1e-14);
  }
  EXPECT_LT(basis.place_of(-1e-300).knot, 5) << "a way just short of the start";
}

/// Cox and de Boor's recursion, on knots one apart.
double b_spline(int degree, double place) {
  if (degree == 0) return place >= 0.0 && place < 1.0 ? 1.0 : 0.0;
  return (place * b_spline(degree - 1, place) +
          (degree + 1 - place) * b_spline(degree - 1, place - 1.0)) /
         degree;
}

TEST(ClosedSplineBasis, HasTheSplinesOfTheRecursion) {
  const ClosedSplineBasis basis(6.0, 6);
  for (const double part : {0.0, 0.2, 0.5, 0.9}) {
    const auto spot = basis.at(2.0 + part);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(spot.values[i], b_spline(3, 3 - i + part), 1e-14);
  }
}

}  // namespace
}  // namespace instep
