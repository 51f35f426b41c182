#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/foot/foot_scan.h"
#include "core/foot/full_size.h"
#include "core/foot/skin/skin_border.h"
#include "core/geometry/seen_skin.h"

namespace instep {

/// Height up to which points make the outline in which landmarks are searched, at full size.
inline constexpr double kLandmarkOutlineHeightMm = 25.0;

/// An aligned foot as the rules of landmarks see it: as a right foot (a left one is mirrored, so
/// that medial is +y and both sides are measured alike) of full size (full_size.h), with its
/// borders. All places and lengths here are of that; in_foot_frame() leads back.
class FootOutline {
 public:
  /// `foot` must have the landmarks of align_foot().
  explicit FootOutline(const FootScan& foot);

  double length_mm() const { return kFullSizeMm; }

  /// How much larger than the foot itself it is seen.
  double factor() const { return factor_; }

  /// A landmark that was found here, on the foot itself.
  Landmark in_foot_frame(Landmark landmark) const;

  const std::vector<Eigen::Vector3d>& points() const { return points_; }

  /// Those of the points that were not put where nobody looked.
  const std::vector<Eigen::Vector3d>& seen_points() const {
    return seen_points_.empty() ? points_ : seen_points_;
  }

  bool has_unseen_points() const { return !seen_points_.empty(); }

  /// Whether a place is on skin that was seen (SeenSkin::is_near()), and how far it is from that:
  /// in a cloud to which nothing was added, all places are. Where a wall was lost, as between two
  /// feet, what is put below its rim reaches less far the deeper it is: close under it, to 6 mm, it
  /// still tells.
  bool was_seen(const Eigen::Vector3d& place) const;
  bool is_told(const Eigen::Vector3d& place) const;
  double distance_to_seen(const Eigen::Vector3d& place) const;

  /// Reach towards medial, and towards lateral, at each x, of the skin up to
  /// kLandmarkOutlineHeightMm.
  const SkinBorder& medial() const { return medial_; }
  const SkinBorder& lateral() const { return lateral_; }

 private:
  Eigen::Vector3d on_foot(const Eigen::Vector3d& place) const;

  double factor_;
  double medial_sign_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> seen_points_;  ///< none where all were seen
  std::optional<SeenSkin> seen_skin_;         ///< of the foot as it is; none where all were seen
  SkinBorder medial_;
  SkinBorder lateral_;
};

}  // namespace instep
