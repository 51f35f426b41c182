#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/geometry/voxel_grid.h"
#include "core/surface/opposite_walls.h"

namespace instep {

/// Unit normals of a surface, one for each cell of its points, two where a thin part shows both of
/// its walls; their sign means nothing before they are oriented. A cell is small enough that its
/// points share a normal and large enough that few normals do for many points.
class CellNormals {
 public:
  /// By principal components (the paper, section 3.2) over the points of a cell and those round it;
  /// where they are fewer than `fewest`, over that many nearest ones, and where they lie on one
  /// line over those of the lines beside it. Where they are thicker than `sigma`, their noise,
  /// explains, opposite walls are looked for. `side` > 0: of a cell. In a unit in which the section
  /// is one across.
  CellNormals(const std::vector<Eigen::Vector3d>& points, const PointIndex& index, double side,
              double sigma, std::size_t fewest);

  /// Turns normals to agree with their neighbours along a minimum spanning tree of the bends (Hoppe
  /// 1992; bends of less than 8 degrees in any order), within parts that no sharp edge crosses. A
  /// part that plainly faces away from the middle of all, or towards it, is turned as a whole: over
  /// a ring round the third axis the sum of normal times place is twice its area, wherever the
  /// middle is taken. The others follow their neighbours.
  void orient_by_neighbours();

  /// The normal of each point: that of its facet.
  std::vector<Eigen::Vector3d> of_points() const;

 private:
  /// The points of a cell, or of one of the two walls in it.
  struct Facet {
    std::size_t cell;
    Eigen::Vector3d middle;
    Eigen::Vector3d normal;

    /// How far a place is off its plane.
    double off(const Eigen::Vector3d& place) const { return std::abs(normal.dot(place - middle)); }
  };
  /// What the points in a cell and round it show.
  struct Look {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of the cell's own
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of all
    bool is_thick = false;                             ///< no one plane explains them
    std::optional<OppositeWalls> walls;
    std::vector<std::uint8_t> sides;  ///< of the cell's own, of walls
  };
  /// Facets that hang together without a sharp bend, their normals on one side.
  struct Part {
    std::vector<std::size_t> facets;
    double outward = 0.0;
  };

  void find_walls(const std::vector<Eigen::Vector3d>& points, std::size_t cell, Look& look) const;
  void set_facets(const std::vector<Eigen::Vector3d>& points, const std::vector<Look>& looks);
  void add_walls(const std::vector<Eigen::Vector3d>& points, std::size_t cell, const Look& look);
  void share_out(const std::vector<Eigen::Vector3d>& points, std::size_t cell);
  bool goes_on(std::size_t facet, std::size_t next) const;
  bool is_wall_of(const Facet& wall, const Facet& other) const;
  void find_links(std::size_t facet, std::vector<std::size_t>& links) const;
  std::vector<std::size_t> orient_part(std::size_t root, std::vector<double>& least_bends);
  Eigen::Vector2d middle_of_all() const;
  double outward_share(const std::vector<std::size_t>& facets, const Eigen::Vector2d& middle) const;
  double agreement_with(const std::vector<bool>& sure,
                        const std::vector<std::size_t>& facets) const;

  VoxelGrid grid_;
  bool quiet_ = false;                   ///< noise hides no wall
  std::vector<Facet> facets_;            ///< cell by cell
  std::vector<std::uint32_t> begins_;    ///< first facet of each cell, and the end of the last
  std::vector<std::uint32_t> facet_of_;  ///< each point
  PointIndex middle_index_;              ///< of the facets
};

}  // namespace instep
