#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/surface/creased_patch.h"
#include "core/surface/height_patch.h"
#include "core/surface/hermite_patch.h"
#include "core/surface/noise_estimate.h"
#include "core/surface/oriented_point.h"

namespace instep {

/// The local RBF implicit surface: overlapping patches, blended by a partition of unity (Wendland
/// weights), so that nothing jumps where the paper's octree cells meet. The field is zero on the
/// surface, positive outside.
///
/// A patch is as wide as its neighbours make it, wider where noise asks for it and the surface
/// allows it, has two sheets where the points tell a crease, and is a field in space where a thin
/// part shows it both of its sides. Patches are fitted where they are
/// asked for, around the places that were visited; so only those that a plane crosses are ever
/// solved. The field changes a little when a patch is added: visit all places first, then read.
/// Not for use from several threads at once.
class BlendedSurface {
 public:
  /// `roughness`: of the surface, see there. At least four points, in a unit in which the body is
  /// about one long.
  BlendedSurface(std::vector<OrientedPoint> points, std::vector<LocalRoughness> roughness);

  /// Makes sure that a patch is centred nearby. False if none can be fitted there.
  bool visit(const Eigen::Vector3d& place);

  /// Nothing outside all patches.
  std::optional<FieldValue> at(const Eigen::Vector3d& place) const;

  /// Distance from the place to the nearest point.
  double distance_to_data(const Eigen::Vector3d& place) const;

  std::size_t patches() const { return patches_.size(); }

 private:
  using Neighbours = std::vector<PointIndex::Neighbour>;

  struct Patch {
    Eigen::Vector3d centre;
    Eigen::Vector3d middle;  ///< of its points; off the centre at the edge of a hole
    double radius;
    std::variant<HeightPatch, CreasedPatch, HermitePatch> field;

    FieldValue at(const Eigen::Vector3d& place) const;
  };

  /// What a place knows of its surroundings before a patch is fitted there.
  struct Surroundings {
    Neighbours nearest;
    double reach = 0.0;       ///< of those
    Eigen::Vector3d outward;  ///< out of the body, here
    double spacing = 0.0;     ///< between points
    double noise_area = 0.0;  ///< variance of a point times the area it has for itself
    double roughness = 0.0;

    double bandwidth(double of_roughness) const;
  };

  /// The points of a patch.
  struct Members {
    std::vector<OrientedPoint> all;    ///< but those on the other side of the body
    std::vector<OrientedPoint> front;  ///< those of them that face as the middle does
    Eigen::Vector3d outward = Eigen::Vector3d::Zero();
    double radius = 0.0;
    double front_radius = 0.0;
  };

  Neighbours nearest_all_round(const Eigen::Vector3d& place) const;
  Eigen::Vector3d outward_of(const Neighbours& nearest) const;
  Surroundings surroundings_of(const Eigen::Vector3d& place) const;
  static void drop_strays(Members& members);
  Members members_of(const Surroundings& surroundings, const Eigen::Vector3d& place,
                     double width) const;
  bool is_thin(const Neighbours& nearest) const;
  std::optional<Patch> fit_in_space(const Surroundings& surroundings,
                                    const Eigen::Vector3d& place) const;
  std::optional<Patch> fit(const Eigen::Vector3d& place) const;

  std::vector<OrientedPoint> points_;
  std::vector<Eigen::Vector3d> positions_;
  PointIndex index_;
  std::vector<LocalRoughness> roughness_;
  std::vector<Patch> patches_;
};

}  // namespace instep
