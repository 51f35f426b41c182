#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep {

struct WallSettings {
  double highest_mm = 35.0;  ///< a wall that was seen no lower than this has no foot
  /// Of the seen wall, upward from its lowest point, that tells how it bends.
  double bend_reach_mm = 14.0;
  double usual_radius_mm = 8.0;  ///< of the rounding, where the seen wall is upright to its end
  double least_inset_mm = 3.0;
  double most_inset_mm = 55.0;
};

/// The lowest seen piece of the wall of a foot, and how its skin is taken to go on, unseen, to the
/// platform: what a tape stretched over it would touch.
///
/// In the upright plane square to the wall the skin at its lowest seen point is `height` over the
/// platform, its normal points an angle `dip` below the horizon, and it bends with some radius.
/// Two cases follow from these three:
///   rounded edge  Bending on like this it would meet the platform at an angle. So it bends
///                 tighter: in the one arc that is tangent to the platform, of radius
///                 height / (1 - sin dip), after a straight piece where that is too wide for an
///                 upright wall.
///   arch          Bending on like this it would turn level above the platform: a roof, with a
///                 hollow that no tape enters. It bends on as it does until it points at the
///                 contact, and from there the tape runs straight.
/// The contact lies where the arc of the first case touches: height cos(dip) / (1 - sin(dip))
/// inward. Below an arch this is a guess, but a tape that comes down at an angle a feels only
/// 1 - cos(a) of it: a twentieth at 18 degrees.
class WallFoot {
 public:
  /// `out`: horizontal unit vector. `sine_of_dip` is cut to 0..0.95. `bend_radius` > 0, infinite
  /// for a straight wall.
  WallFoot(const Eigen::Vector2d& place, const Eigen::Vector2d& out, double height,
           double sine_of_dip, double bend_radius, const WallSettings& settings);

  const Eigen::Vector2d& place() const { return place_; }
  const Eigen::Vector2d& out() const { return out_; }

  /// How far inward from the wall's foot a place lies, and how far to the side.
  double inward(const Eigen::Vector2d& place) const { return -out_.dot(place - place_); }
  double sideways(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d offset = place - place_;
    return out_.x() * offset.y() - out_.y() * offset.x();
  }

  /// Inward distance from which on the skin rests on the platform.
  double contact() const { return contact_; }

  /// Height of the skin over the platform at an inward distance >= 0.
  double skin_height(double inward) const;

 private:
  Eigen::Vector2d place_;
  Eigen::Vector2d out_;
  double height_;
  double contact_ = 0.0;
  double radius_ = 0.0;                               ///< of the arc
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();  ///< of the arc: inward, height
  double arc_begins_ = 0.0;                           ///< inward distance
  double arc_ends_ = 0.0;
};

/// The feet of the walls of a foot that stands at a height, one for each 6 mm or so round it. The
/// cloud is in the station frame and has normals. About 3 ms for 40,000 points.
std::vector<WallFoot> find_wall_feet(const PointCloud& foot, double standing_height_mm,
                                     const WallSettings& settings);

}  // namespace instep
