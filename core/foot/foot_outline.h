#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/foot/border_profile.h"
#include "core/foot/foot_scan.h"

namespace instep {

/// Height up to which points make the outline in which landmarks are searched.
inline constexpr double kLandmarkOutlineHeightMm = 25.0;

/// An aligned foot as the rules of landmarks see it: as a right foot (a left one is mirrored, so
/// that medial is +y and both sides are measured alike), with its borders.
class FootOutline {
 public:
  /// `foot` must have the landmarks of align_foot().
  explicit FootOutline(const FootScan& foot);

  double length_mm() const { return length_mm_; }

  /// All points, and those of the outline.
  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  const std::vector<Eigen::Vector3d>& low_points() const { return low_points_; }

  /// Reach towards medial, and towards lateral, at each x.
  const BorderProfile& medial() const { return medial_; }
  const BorderProfile& lateral() const { return lateral_; }

  /// The skin's height at a place of the border: mean height of the outline's points close to it,
  /// or half the outline's height if there are none.
  double border_height(const Eigen::Vector2d& place) const;

 private:
  double length_mm_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> low_points_;
  BorderProfile medial_;
  BorderProfile lateral_;
};

}  // namespace instep
