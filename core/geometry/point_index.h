#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

namespace instep {

/// Finds neighbours among points in space (a k-d tree).
///
/// Keeps the points itself. All coordinates must be finite. Building costs O(n log n); queries
/// O(log n + found) on typical data, and may be made from many threads at once. Duplicates are
/// allowed.
class PointIndex {
 public:
  struct Neighbour {
    std::size_t index = 0;
    double squared_distance = 0.0;
  };

  explicit PointIndex(std::vector<Eigen::Vector3d> points);
  ~PointIndex();
  PointIndex(PointIndex&&) noexcept;
  PointIndex& operator=(PointIndex&&) noexcept;

  /// The `count` nearest points (fewer if there are fewer), nearest first; equal distances are
  /// ordered by index. Of several equally far ones at the last place any may be left out.
  std::vector<Neighbour> nearest(const Eigen::Vector3d& query, std::size_t count) const;

  /// All points within `radius` (inclusive), nearest first, ordered as above.
  std::vector<Neighbour> within(const Eigen::Vector3d& query, double radius) const;

  /// The same in no order but always the same one for the same list of points: quicker where many
  /// are found.
  std::vector<Neighbour> around(const Eigen::Vector3d& query, double radius) const;

  const std::vector<Eigen::Vector3d>& points() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace instep
