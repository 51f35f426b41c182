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

  /// The four splines that are not zero at a place.
  struct Spot {
    std::array<Eigen::Index, 4> terms;  ///< their numbers
    Eigen::Vector4d values;
    Eigen::Vector4d slopes;  ///< along the line
  };
  Spot at(double way) const;

  double length() const { return length_; }
  Eigen::Index knots() const { return knots_; }

 private:
  double length_;
  Eigen::Index knots_;
};

}  // namespace instep
