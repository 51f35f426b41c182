#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep {

/// A wall that was seen no lower than this over the platform has no foot.
inline constexpr double kHighestWallEndMm = 50.0;
/// Of the seen wall, upward from its lowest point, that tells how it bends.
inline constexpr double kWallBendReachMm = 14.0;

struct WallSettings {
  double usual_edge_mm = 8.0;  ///< height over the platform where the sole's round edge begins
};

/// The lower end of a wall as it was seen.
struct WallShape {
  double height = 0.0;  ///< over the platform, mm
  /// Of the angle of the normal below the horizon, cut to -0.95..0.95; below 0 where the wall was
  /// lost above its widest place.
  double sine_of_dip = 0.0;
  double bend = 0.0;           ///< curvature on the way down, 1/mm; 0 for a straight wall
  double most_inset_mm = 0.0;  ///< the contact lies no further inward; see WallFoot
};

/// The lowest seen piece of the wall of a foot, and how its skin is taken to go on, unseen, to the
/// platform: what a tape stretched over it would touch.
///
/// In the upright plane square to the wall the skin begins with the height, the dip and the bend of
/// the seen end; from an end above the widest place first outwards, by 2 mm at the most. Two cases
/// follow:
///   rounded edge  It goes on in its own bend down to where soles usually begin to be round, or to
///                 where it leans in as a sole's edge does, and hangs free from there until it
///                 rests on the platform: free_skin(). An end below the usual edge that leans in
///                 less is taken to lean in at once: the edge has begun there. The free skin is an
///                 arc, as the edges of scanned feet are; where the wall ends well above the usual
///                 edge, as beside an arch, or bends more than such an arc, a slope.
///   arch          That contact would lie beyond `most_inset_mm`: the wall bends so much that it
///                 turns level above the platform, a roof with a hollow that no tape enters. The
///                 skin bends on in an arc until it points at that place, and from there the tape
///                 runs straight.
/// The contact lies 3 mm inward at the least.
class WallFoot {
 public:
  /// `out`: horizontal unit vector.
  WallFoot(const Eigen::Vector2d& place, const Eigen::Vector2d& out, const WallShape& shape,
           const WallSettings& settings = {});

  const Eigen::Vector2d& place() const { return place_; }
  const Eigen::Vector2d& out() const { return out_; }

  /// How far inward from the wall's foot a place lies, and how far to the side.
  double inward(const Eigen::Vector2d& place) const { return -out_.dot(place - place_); }
  double sideways(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d offset = place - place_;
    return out_.x() * offset.y() - out_.y() * offset.x();
  }

  /// Inward distance from which on the skin rests on the platform.
  double contact() const { return course_.back().x(); }

  /// Height of the skin over the platform at an inward distance >= 0.
  double skin_height(double inward) const;

  /// A place on the skin, and how it leans there.
  struct Place {
    double inward = 0.0;
    double height = 0.0;
    double sine_of_dip = 0.0;
  };

  /// Places on the wall below its seen end, so far apart along it, down to where the skin hangs
  /// free; none where it was seen so far, or turns over an arch.
  std::vector<Place> hidden_wall(double spacing) const;

 private:
  Eigen::Vector2d place_;
  Eigen::Vector2d out_;
  std::vector<Eigen::Vector2d> course_;  ///< inward, height; from the wall's end to the contact
  std::size_t wall_corners_ = 0;         ///< of these, down to where the skin hangs free
};

/// The feet of the walls of a foot that stands at a height, one for each 6 mm or so round it. The
/// cloud is in the station frame and has normals. About 4 ms for 40,000 points.
std::vector<WallFoot> find_wall_feet(const PointCloud& foot, double standing_height_mm);

}  // namespace instep
