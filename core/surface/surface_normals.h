#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/geometry/voxel_grid.h"

namespace instep {

/// Unit normals of a surface, one for each cell of its points; their sign means nothing before they
/// are oriented. A cell is small enough that its points share a normal and large enough that few
/// normals do for many points.
class CellNormals {
 public:
  /// By principal components (the paper, section 3.2) over the points of a cell and those round it;
  /// where they are fewer than `fewest`, over that many nearest ones, and where they lie on one
  /// line over those of the lines beside it. `side` > 0: of a cell. In a unit in which the section
  /// is one across.
  CellNormals(const std::vector<Eigen::Vector3d>& points, const PointIndex& index, double side,
              std::size_t fewest);

  /// Turns normals to agree with their neighbours along a minimum spanning tree of the bends (Hoppe
  /// 1992; bends of less than 8 degrees in any order), within parts that no sharp edge crosses. A
  /// part that plainly faces away from the middle of all, or towards it, is turned as a whole: over
  /// a ring round the third axis the sum of normal times place is twice its area, wherever the
  /// middle is taken. The others follow their neighbours.
  void orient_by_neighbours();

  /// The normal of each point: that of its cell.
  std::vector<Eigen::Vector3d> of_points() const;

 private:
  /// Cells that hang together without a sharp bend, their normals on one side.
  struct Part {
    std::vector<std::size_t> cells;
    double outward = 0.0;
  };

  void find_links(std::size_t cell, std::vector<std::size_t>& links) const;
  std::vector<std::size_t> orient_part(std::size_t root, std::vector<double>& least_bends);
  Eigen::Vector2d middle_of_all() const;
  double outward_share(const std::vector<std::size_t>& cells, const Eigen::Vector2d& middle) const;
  double agreement_with(const std::vector<bool>& sure, const std::vector<std::size_t>& cells) const;

  VoxelGrid grid_;
  std::size_t points_;
  std::vector<Eigen::Vector3d> middles_;
  PointIndex middle_index_;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace instep
