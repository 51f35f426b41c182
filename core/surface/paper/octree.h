#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace instep {

/// Cubes in which points are counted (the paper, section 4.1): the smallest cube round all points
/// is divided into eight, and each of these again, until none holds more than a given number.
/// Cubes without points are marked as empty.
///
/// Read-only once built; coordinates must be finite, at least one point. O(n log n) for points that
/// are not in heaps.
class Octree {
 public:
  /// A cube that is not divided and holds at least one point.
  struct Leaf {
    Eigen::AlignedBox3d box;
    std::vector<std::uint32_t> points;
  };

  /// `most` >= 1: of points in a leaf. Points that double precision cannot part stay together.
  Octree(const std::vector<Eigen::Vector3d>& points, std::size_t most);

  const std::vector<Leaf>& leaves() const { return leaves_; }

  /// The leaf that holds a place; nothing in an empty cube or outside all.
  std::optional<std::size_t> leaf_at(const Eigen::Vector3d& place) const;

  /// The leaf nearest to a place; nothing if all are further away than `reach`.
  std::optional<std::size_t> nearest_leaf(const Eigen::Vector3d& place, double reach) const;

  /// The other leaves that touch one, by a face, an edge or a corner, ascending. O(leaves).
  std::vector<std::size_t> touching(std::size_t leaf) const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  struct Node {
    Eigen::Vector3d middle;
    std::uint32_t first_child = kNone;  ///< of eight that follow each other
    std::uint32_t leaf = kNone;
  };

  void divide(std::uint32_t node, const Eigen::AlignedBox3d& box,
              const std::vector<Eigen::Vector3d>& points, std::vector<std::uint32_t> members,
              std::size_t most, int depth);

  void search(std::uint32_t node, const Eigen::AlignedBox3d& box, const Eigen::Vector3d& place,
              double& squared_distance, std::optional<std::size_t>& nearest) const;

  Eigen::AlignedBox3d root_;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

/// The points from which the surface of each leaf is reconstructed (the paper's combination): its
/// own and, while `suffices` refuses them, also those of the neighbouring leaf with the fewest
/// points; neighbours are those of any leaf joined so far. The leaves themselves stay as they are.
/// Ends without having sufficed where no neighbour is left or more than `most` points are joined.
std::vector<std::vector<std::uint32_t>> combined_points(
    const Octree& octree, std::size_t most,
    const std::function<bool(const std::vector<std::uint32_t>&)>& suffices);

}  // namespace instep
