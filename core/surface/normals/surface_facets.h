#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/geometry/voxel_grid.h"
#include "core/surface/heights/opposite_walls.h"

namespace instep {

/// A surface by flat pieces, one for each cubic cell of its points, or two where a thin part shows
/// both of its walls. A cell is small enough that its points share a normal and large enough that
/// few normals do for many points.
class SurfaceFacets {
 public:
  /// The points of a cell, or of one of the two walls in it.
  struct Facet {
    std::size_t cell;
    Eigen::Vector3d middle;
    Eigen::Vector3d normal;  ///< of unit length and either sign

    /// How far a place is off its plane.
    double off(const Eigen::Vector3d& place) const { return std::abs(normal.dot(place - middle)); }
  };

  /// By principal components (the paper, section 3.2) over the points of a cell and those round it;
  /// where they are fewer than `fewest`, over that many nearest ones, and where they lie on one
  /// line over those of the lines beside it. Where they are thicker than `sigma`, their noise,
  /// explains, opposite walls are looked for. `side` > 0: of a cell. In a unit in which the section
  /// is one across. O(points log points).
  SurfaceFacets(const PointIndex& index, double side, double sigma, std::size_t fewest);

  std::size_t size() const { return facets_.size(); }
  const Facet& operator[](std::size_t facet) const { return facets_[facet]; }
  auto begin() const { return facets_.begin(); }
  auto end() const { return facets_.end(); }

  /// To the other side.
  void turn(std::size_t facet) { facets_[facet].normal *= -1.0; }

  /// Those of the cells round it, itself included, or where they are few the nearest ones.
  void find_links(std::size_t facet, std::vector<std::size_t>& links) const;

  /// Whether the skin may run from one facet on to the other, and not across a thin part.
  bool goes_on(std::size_t facet, std::size_t next) const;

  /// That of its facet for each point.
  std::vector<Eigen::Vector3d> normals_of_points() const;

 private:
  /// What the points in a cell and round it show.
  struct Look {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of the cell's own
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of all
    bool is_thick = false;                             ///< no one plane explains them
    std::optional<OppositeWalls> walls;
    std::vector<std::uint8_t> sides;  ///< of the cell's own, of walls
  };

  void find_walls(const std::vector<Eigen::Vector3d>& points, std::size_t cell, Look& look) const;
  void set_facets(const std::vector<Eigen::Vector3d>& points, const std::vector<Look>& looks);
  void add_walls(const std::vector<Eigen::Vector3d>& points, std::size_t cell, const Look& look);
  void share_out(const std::vector<Eigen::Vector3d>& points, std::size_t cell);
  bool is_wall_of(const Facet& wall, const Facet& other) const;

  VoxelGrid grid_;
  bool quiet_ = false;                   ///< noise hides no wall
  std::vector<Facet> facets_;            ///< cell by cell
  std::vector<std::uint32_t> begins_;    ///< first facet of each cell, and the end of the last
  std::vector<std::uint32_t> facet_of_;  ///< each point
  PointIndex middle_index_;              ///< of the facets
};

}  // namespace instep
