#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/geometry/rigid_transform.h"
#include "core/result.h"

namespace instep {

/// Part of the foot's length up to which points count as its outline from above: 40 mm for a foot
/// of 270 mm. The whole heel and the toes are below, the leg is not.
inline constexpr double kOutlineHeightShare = 0.15;
/// Part of the foot's length that is looked at for the heel's end.
inline constexpr double kHeelShare = 0.15;

/// Where a standing body's heel is and which way its toes point, from nothing but its outline and
/// heights.
struct OutlineAxis {
  Eigen::Vector2d heel = Eigen::Vector2d::Zero();      ///< rear end of the outline
  Eigen::Vector2d forward = Eigen::Vector2d::UnitX();  ///< unit length
  double length_mm = 0.0;

  /// Puts the heel at the origin and the toes on +x.
  RigidTransform axis_from_standing() const;
};

/// The longer principal axis of the area that points have from above, either way; nothing where
/// they have none. Points that lie denser in one place than in another do not turn it.
std::optional<Eigen::Vector2d> long_direction(const std::vector<Eigen::Vector3d>& points);

/// The longer principal axis of the outline's area, pointing from the high end (leg, instep) to
/// the low one (toes). Good to a few degrees: the start for a foot axis by landmarks.
///
/// `points` stand on z = 0. Fails, saying why, where the body has no foot's length (120-360 mm), no
/// foot's breadth, or not the heights of toes at its lower end and of an instep behind them.
Result<OutlineAxis> find_outline_axis(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
