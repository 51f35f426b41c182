#include "core/surface/closed_spline_basis.h"

#include <cmath>

namespace instep {

ClosedSplineBasis::ClosedSplineBasis(double length, Eigen::Index knots)
    : length_(length), knots_(knots) {}

ClosedSplineBasis::Spot ClosedSplineBasis::at(double way) const {
  const double per_length = static_cast<double>(knots_) / length_;
  const double turns = way / length_;
  const double place = (turns - std::floor(turns)) * static_cast<double>(knots_);
  Eigen::Index term = static_cast<Eigen::Index>(place);
  const double t = place - static_cast<double>(term);
  const double rest = 1.0 - t;
  Spot spot;
  for (auto& number : spot.terms) {
    if (term >= knots_) term -= knots_;
    number = term++;
  }
  spot.values << rest * rest * rest, (3.0 * t - 6.0) * t * t + 4.0,
      (3.0 * rest - 6.0) * rest * rest + 4.0, t * t * t;
  spot.values /= 6.0;
  spot.slopes << -rest * rest, (3.0 * t - 4.0) * t, -(3.0 * rest - 4.0) * rest, t * t;
  spot.slopes *= 0.5 * per_length;
  return spot;
}

}  // namespace instep
