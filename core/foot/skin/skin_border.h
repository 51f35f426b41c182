#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace instep {

/// From where a border is looked at: how far the skin reaches in one direction, at each place along
/// another; what lies at any place across counts, within limits.
struct BorderView {
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();  ///< the three at right angles, unit length
  Eigen::Vector3d outwards = Eigen::Vector3d::UnitY();
  Eigen::Vector3d across = Eigen::Vector3d::UnitZ();
  double across_from_mm = 0.0;
  double across_to_mm = 0.0;
};

/// The silhouette of a body, told from noisy points on its skin: how far it reaches at each place
/// along a line.
///
/// Taking the furthest point of a strip would add the noise of the points (two or three standard
/// deviations of it where they are dense) and lose the skin between them. So at places 2 mm apart a
/// quadratic surface is fitted to the points round the furthest ones, and its summit across the
/// line is taken, within the limits. Strays do not count. The samples so found are smoothed along
/// the line by local quadratics.
class SkinBorder {
 public:
  struct Place {
    double along = 0.0;
    double reach = 0.0;   ///< outwards
    double across = 0.0;  ///< where the reach is greatest
    double bend = 0.0;    ///< second derivative of the reach, per mm; < 0 on a summit
  };

  /// `smoothing_mm` is how far to either side of a place a sample has a say; where samples are
  /// missing, as over a hole, up to 2.5 times as far.
  SkinBorder(const std::vector<Eigen::Vector3d>& points, const BorderView& view,
             double smoothing_mm);

  /// The same border, smoothed over another length.
  SkinBorder smoothed_over(double smoothing_mm) const;

  /// The same border without the samples that `is_told` denies.
  SkinBorder where(const std::function<bool(const Place&)>& is_told) const;

  const BorderView& view() const { return view_; }

  /// As fitted, before they are smoothed; by place.
  const std::vector<Place>& samples() const { return samples_; }

  /// Smoothed; nothing where too few places near by have points.
  std::optional<Place> at(double along) const;

  std::optional<double> reach(double along) const;

  /// A place of the border in the frame of the points.
  Eigen::Vector3d position(const Place& place) const;

  /// The furthest place in a range; nothing where the range holds no points, or ends before it
  /// begins. A `handicap` (mm, by place) is taken off before comparing, so that among nearly equal
  /// places a likely one wins.
  std::optional<Place> furthest(double from, double to,
                                const std::function<double(double)>& handicap = {}) const;

 private:
  /// Samples that have a say in a place.
  struct Reach {
    std::vector<Place>::const_iterator begin;
    std::vector<Place>::const_iterator end;
    double half_mm = 0.0;  ///< how far to either side
  };
  /// On both sides of it, across gaps where need be; at an end of the border on one.
  std::optional<Reach> samples_near(double along) const;

  BorderView view_;
  std::vector<Place> samples_;  ///< by place
  double smoothing_mm_;
};

}  // namespace instep
