#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/result.h"
#include "core/surface/paper/octree.h"
#include "core/surface/paper/triharmonic_rbf.h"

namespace instep {

/// Told how much of the work is done, from 0 to 1.
using SurfaceProgress = std::function<void(double done)>;

/// The paper's local RBF implicit surface (sections 3.2, 3.3 and 4), as it is written: one radial
/// basis function for each leaf of an octree, with no transition from one to the next. Positive
/// inside, negative outside, zero on the surface.
///
/// Lambda is zero, so that the surface goes through every point, as the paper says it does. It
/// gives no other value, and none helps against noise: off-surface points lie so near their points
/// that lambda takes the side from the field before it takes the noise (1 mm^3 tore the surface of
/// a clean cloud of 6,000 points).
///
/// Where the sides of the normals were found wrongly (see box_normals.h) the surface is torn, and
/// on the faces between leaves it may jump. A surface without these faults is BlendedSurface.
/// Read-only once built, and then safe to read from many threads.
class OctreeSurface {
 public:
  /// Points in their principal frame. Those within a thousandth of the spacing of another are
  /// left out. Fails with kInsufficientData if the points are too few, or lie so that no leaf
  /// determines a surface. O(n log n + n m^2), where m = 300 is
  /// the most points of a leaf.
  static Result<OctreeSurface> reconstruct(const std::vector<Eigen::Vector3d>& points,
                                           const SurfaceProgress& progress = {});

  /// The points that were kept, through which the surface goes.
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

  /// Of their minimum spanning tree.
  double longest_edge() const { return longest_edge_; }

  /// The leaf in which a place lies, if it has a surface. Empty cubes have none.
  std::optional<std::size_t> leaf_at(const Eigen::Vector3d& place) const;

  /// The field that was reconstructed for a leaf, anywhere.
  double value_of_leaf(std::size_t leaf, const Eigen::Vector3d& place) const {
    return fields_[leaf]->at(place);
  }

  /// The field of the leaf at a place; in an empty cube, or outside all, that of the nearest leaf
  /// within `reach`.
  std::optional<double> at(const Eigen::Vector3d& place, double reach = 0.0) const;

 private:
  OctreeSurface(std::vector<Eigen::Vector3d> points, Octree octree)
      : points_(std::move(points)), octree_(std::move(octree)) {}

  std::vector<Eigen::Vector3d> points_;
  double longest_edge_ = 0.0;
  Octree octree_;
  std::vector<std::optional<TriharmonicRbf>> fields_;  ///< one a leaf
};

}  // namespace instep
