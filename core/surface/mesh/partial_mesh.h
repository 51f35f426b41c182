#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace instep {

/// A surface while it grows: the triangles it has so far, and whether another one lies clear of
/// them. All triangles are wound alike, so that a directed edge belongs to one triangle at most and
/// the finished surface is a manifold, but for single corners where two parts may touch.
///
/// Borrows the points, which must be finite. What it once does not accept it never will, since it
/// only grows.
class PartialMesh {
 public:
  using Corner = std::uint32_t;
  using Triangle = std::array<Corner, 3>;

  explicit PartialMesh(const std::vector<Eigen::Vector3d>& points);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  bool has_corner(Corner corner) const { return !fans_[corner].empty(); }
  /// Whether triangles lie all round the corner.
  bool is_surrounded(Corner corner) const { return has_corner(corner) && borders_[corner].empty(); }
  /// Whether a triangle runs from one corner to the other in this direction.
  bool has_edge(Corner from, Corner to) const;

  /// The far ends of the border's edges at a corner.
  const std::vector<Corner>& border_at(Corner corner) const { return borders_[corner]; }

  /// Whether all three edges run in the other direction, and none in that of the triangle.
  bool is_hole(const Triangle& triangle) const;

  /// Whether a triangle shares no directed edge with the others, overlaps none of them round its
  /// corners, and neither holds one of the `nearby` corners nor crosses the border there. Corners
  /// of the triangle itself may be among those nearby. O(nearby).
  bool accepts(const Triangle& triangle, const std::vector<Corner>& nearby) const;

  void add(const Triangle& triangle);

 private:
  /// What a triangle spans at one of its corners, from one edge to the other.
  struct Sector {
    Corner from;
    Corner to;
  };

  static std::vector<Corner> border_of(const std::vector<Sector>& fan);
  Eigen::Vector3d normal_of(const Triangle& triangle) const;
  bool is_clear_at(Corner corner, const Sector& sector, const Eigen::Vector3d& normal) const;
  bool is_clear_of_others(const Triangle& triangle, const Eigen::Vector3d& normal,
                          const std::vector<Corner>& nearby) const;

  const std::vector<Eigen::Vector3d>& points_;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<Sector>> fans_;     ///< of each corner
  std::vector<std::vector<Corner>> borders_;  ///< far ends of the border's edges at each corner
  std::vector<Eigen::Vector3d> normals_;      ///< sum over the fan of each corner
};

}  // namespace instep
