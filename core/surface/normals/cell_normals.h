#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/surface/normals/surface_facets.h"

namespace instep {

/// Unit normals of a surface, those of its facets; their sign means nothing before they are
/// oriented.
class CellNormals {
 public:
  /// As SurfaceFacets takes them.
  CellNormals(const PointIndex& index, double side, double sigma, std::size_t fewest);

  /// Turns normals to agree with their neighbours along a minimum spanning tree of the bends (Hoppe
  /// 1992; bends of less than 8 degrees in any order), within parts that no sharp edge crosses, nor
  /// a thin part from wall to wall. A part that plainly faces away from the middle of all, or
  /// towards it, is turned as a whole: over a ring round the third axis the sum of normal times
  /// place is twice its area, wherever the middle is taken. The others follow their neighbours.
  void orient_by_neighbours();

  /// The normal of each point: that of its facet.
  std::vector<Eigen::Vector3d> of_points() const { return facets_.normals_of_points(); }

 private:
  /// Facets that hang together without a sharp bend, their normals on one side.
  struct Part {
    std::vector<std::size_t> facets;
    double outward = 0.0;
  };

  std::vector<std::size_t> orient_part(std::size_t root, std::vector<double>& least_bends);
  Eigen::Vector2d middle_of_all() const;
  double outward_share(const std::vector<std::size_t>& facets, const Eigen::Vector2d& middle) const;
  double agreement_with(const std::vector<bool>& sure,
                        const std::vector<std::size_t>& facets) const;

  SurfaceFacets facets_;
};

}  // namespace instep
