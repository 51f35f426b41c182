#include "core/surface/ribbon/closed_spline_basis.h"

#include <cmath>

namespace instep {

ClosedSplineBasis::ClosedSplineBasis(double length, Eigen::Index knots)
    : length_(length), knots_(knots) {}

ClosedSplineBasis::Place ClosedSplineBasis::place_of(double way) const {
  const double turns = way / length_;
  const double place = (turns - std::floor(turns)) * static_cast<double>(knots_);
  const auto knot = static_cast<Eigen::Index>(place);
  // A way just short of the start may round up to it.
  return {knot < knots_ ? knot : 0, place - static_cast<double>(knot)};
}

std::array<Eigen::Index, 4> ClosedSplineBasis::terms_from(Eigen::Index knot) const {
  std::array<Eigen::Index, 4> terms;
  for (auto& term : terms) {
    if (knot >= knots_) knot -= knots_;
    term = knot++;
  }
  return terms;
}

Eigen::Matrix4d ClosedSplineBasis::polynomials() {
  Eigen::Matrix4d factors;
  factors << 1.0, -3.0, 3.0, -1.0,  //
      4.0, 0.0, -6.0, 3.0,          //
      1.0, 3.0, 3.0, -3.0,          //
      0.0, 0.0, 0.0, 1.0;
  return factors / 6.0;
}

ClosedSplineBasis::Spot ClosedSplineBasis::at(double way) const {
  const auto [knot, t] = place_of(way);
  const double rest = 1.0 - t;
  Spot spot{terms_from(knot), {}};
  spot.values << rest * rest * rest, (3.0 * t - 6.0) * t * t + 4.0,
      (3.0 * rest - 6.0) * rest * rest + 4.0, t * t * t;
  spot.values /= 6.0;
  return spot;
}

}  // namespace instep
