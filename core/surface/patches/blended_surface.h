#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/surface/oriented_point.h"
#include "core/surface/patches/patch_fitter.h"

namespace instep {

/// The local RBF implicit surface: overlapping patches, blended by a partition of unity (Wendland
/// weights), so that nothing jumps where the paper's octree cells meet. The field is zero on the
/// surface, positive outside.
///
/// Patches are fitted where they are asked for, around the places that were visited; so only those
/// that a plane crosses are ever solved. The field changes a little when a patch is added: visit
/// all places first, then read. Not for use from several threads at once.
class BlendedSurface {
 public:
  explicit BlendedSurface(PatchFitter fitter);

  /// Makes sure that a patch is centred nearby. False if none can be fitted there, or where so many
  /// were asked for that the points form no surface.
  bool visit(const Eigen::Vector3d& place);

  /// Nothing outside all patches.
  std::optional<FieldValue> at(const Eigen::Vector3d& place) const;

  /// Distance from the place to the nearest point.
  double distance_to_data(const Eigen::Vector3d& place) const;

  /// The patch that counts most at a place; null outside all patches. Valid until the next visit.
  const SurfacePatch* leading_patch(const Eigen::Vector3d& place) const;

  const std::vector<OrientedPoint>& points() const { return fitter_.points(); }

  std::size_t patches() const { return patches_.size(); }

  /// Of the patches, those that left out strays; nothing without patches.
  double share_with_strays() const;

 private:
  /// Where a patch serves, as squares of distances: beside the patches themselves, for every place
  /// asks it of all of them.
  struct Zone {
    explicit Zone(const SurfacePatch& patch);

    Eigen::Vector3d centre;
    Eigen::Vector3d middle;
    double almost_there;      ///< from the centre: whatever the middle
    double near_enough;       ///< from the centre
    double near_enough_amid;  ///< from the centre, for a place amid many points
    double well_within;       ///< from the middle
    double reach;             ///< from the middle: beyond it the patch counts nothing
    double neighbourhood;     ///< from the middle: beyond it no place nearby asks for the patch
  };

  bool serves(std::size_t patch, const Eigen::Vector3d& place) const;
  const std::vector<std::size_t>& patches_near(const Eigen::Vector3d& place) const;

  PatchFitter fitter_;
  std::vector<SurfacePatch> patches_;
  std::vector<Zone> zones_;   ///< of the patches
  std::size_t failures_ = 0;  ///< places where none could be fitted
  /// Places are asked for one beside the other: the patches that may serve or count near the last
  /// one that was far from those before, in their order.
  mutable std::vector<std::size_t> near_;
  mutable std::optional<Eigen::Vector3d> near_to_;
};

}  // namespace instep
