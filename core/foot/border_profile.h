#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace instep {

/// One side of an outline as a function: how far the body reaches, at each place along a line.
///
/// Points are sorted into strips of 2 mm along the line; in each the furthest point (the median of
/// the three furthest where there are as many, against strays) is a sample, and reach() smooths the
/// samples by a local quadratic. So a peak is found well under the spacing of the points.
class BorderProfile {
 public:
  /// `along` and `reach` (unit vectors, at right angles) are the axes of the function;
  /// `smoothing_mm` is how far to either side a sample has a say.
  BorderProfile(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& along,
                const Eigen::Vector2d& reach, double smoothing_mm);

  /// Smoothed reach at a place; nothing where too few strips near by have points.
  std::optional<double> reach(double place) const;

  struct Peak {
    double place = 0.0;
    double reach = 0.0;
    double rise = 0.0;  ///< above the higher end of the searched range; 0 at an end
  };

  /// The furthest place in a range; nothing where the range holds no points.
  std::optional<Peak> furthest(double from, double to) const;

  /// All summits in a range, in order of place, from which the border falls by at least `fall` to
  /// either side before it rises higher (or before the range ends).
  std::vector<Peak> summits(double from, double to, double fall) const;

 private:
  struct Sample {
    double place = 0.0;
    double reach = 0.0;
  };

  std::vector<Sample> curve(double from, double to) const;

  std::vector<Sample> samples_;  ///< by place
  double smoothing_mm_;
};

}  // namespace instep
