#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace instep {

/// One side of an outline as a function: how far the body reaches, at each place along a line.
///
/// Points are sorted into strips along the line, 2 mm wide (or as asked) or as wide as it takes to
/// hold thirty points; the furthest point of each (the next one, if it stands alone by 3 mm: a
/// stray) is a sample. reach() fits a local quadratic to the samples, in which those that fall
/// short count little: a strip may have no point on the very border. So a peak is found well under
/// the spacing of the points. Where a border is bent as tightly as strips are wide, as between
/// toes, that does not do: a strip that falls short looks like a cleft. Told how tightly a border
/// can be bent at the most, the profile lifts each sample to the parabolas of that bend which its
/// neighbours carry, out to where the smoothing ends.
class BorderProfile {
 public:
  /// `along` and `reach` (unit vectors, at right angles) are the axes of the function;
  /// `smoothing_mm` is how far to either side a sample has a say; `tightest_bend_mm` the least
  /// radius of the border's bends, 0 where it is not to lift samples.
  BorderProfile(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& along,
                const Eigen::Vector2d& reach, double smoothing_mm, double strip_mm = 2.0,
                double tightest_bend_mm = 0.0);

  /// Smoothed reach at a place; nothing where too few strips near by have points.
  std::optional<double> reach(double place) const;

  struct Peak {
    double place = 0.0;
    double reach = 0.0;
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
  void lift_short_samples(double tightest_bend_mm);

  std::vector<Sample> samples_;  ///< by place
  double smoothing_mm_ = 0.0;
};

}  // namespace instep
