#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/foot/foot_scan.h"
#include "core/foot/skin_border.h"
#include "core/geometry/seen_skin.h"

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

  const std::vector<Eigen::Vector3d>& points() const { return points_; }

  /// Those of the points that were not put where nobody looked.
  const std::vector<Eigen::Vector3d>& seen_points() const {
    return seen_points_.empty() ? points_ : seen_points_;
  }

  bool has_unseen_points() const { return !seen_points_.empty(); }

  /// Whether a place is on skin that was seen (SeenSkin::is_near()), and how far it is from that:
  /// in a cloud to which nothing was added, all places are.
  bool was_seen(const Eigen::Vector3d& place) const;
  double distance_to_seen(const Eigen::Vector3d& place) const;

  /// Reach towards medial, and towards lateral, at each x, of the skin up to
  /// kLandmarkOutlineHeightMm.
  const SkinBorder& medial() const { return medial_; }
  const SkinBorder& lateral() const { return lateral_; }

 private:
  double length_mm_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> seen_points_;  ///< none where all were seen
  std::optional<SeenSkin> seen_skin_;         ///< of the foot as it is; none where all were seen
  double medial_sign_;
  SkinBorder medial_;
  SkinBorder lateral_;
};

}  // namespace instep
