#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/girth/contour/contour.h"

namespace instep {

/// Where a contour is, and what it has turned since its first corner, by the way along it. Borrows
/// the contour, of at least two corners. Read-only, and may be shared between threads.
class ContourCourse {
 public:
  /// O(corners).
  explicit ContourCourse(const Contour& contour);

  const Contour& contour() const { return contour_; }
  /// Of the polygon through the corners.
  double length() const { return ways_.back(); }
  double way_to(std::size_t corner) const { return ways_[corner]; }

  /// Radians, over so long a way, which may begin and end beyond the first and the last corner.
  /// O(log corners).
  double turn_over(double begin, double way) const;

  /// On the chords; further than once round as well, either way. O(log corners).
  Eigen::Vector2d place_at(double way) const;

 private:
  struct Station {
    std::size_t corner;  ///< the one behind
    double part;         ///< of the way to the next one
  };
  Station station_at(double way) const;
  double turn_at(double way) const;

  const Contour& contour_;
  std::vector<double> ways_ = {0.0};  ///< to each corner, and all round to the first again
  std::vector<double> turns_ = {0.0};
};

}  // namespace instep
