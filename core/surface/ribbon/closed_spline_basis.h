#pragma once

#include <Eigen/Core>
#include <array>

namespace instep {

/// Cubic B-splines on even knots round a closed line: any smooth function along the line is a sum
/// of them, each times a term of its own. A place on the line is told by its way from some start;
/// one beyond the length goes round again. An immutable value.
class ClosedSplineBasis {
 public:
  /// `length` > 0 of the line, `knots` >= 4.
  ClosedSplineBasis(double length, Eigen::Index knots);

  /// Where a place lies: how far on from which knot, as a part of the way to the next.
  struct Place {
    Eigen::Index knot = 0;
    double part = 0.0;
  };
  Place place_of(double way) const;

  /// The numbers of the four splines that are not zero between a knot and the next.
  std::array<Eigen::Index, 4> terms_from(Eigen::Index knot) const;

  /// Those four as polynomials of the part: a row for each, its factors of rising powers.
  static Eigen::Matrix4d polynomials();

  /// The four splines that are not zero at a place.
  struct Spot {
    std::array<Eigen::Index, 4> terms;  ///< their numbers
    Eigen::Vector4d values;
  };
  Spot at(double way) const;

  double length() const { return length_; }
  double knots_apart() const { return length_ / static_cast<double>(knots_); }
  Eigen::Index knots() const { return knots_; }

 private:
  double length_;
  Eigen::Index knots_;
};

}  // namespace instep
