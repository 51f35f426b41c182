#include "core/surface/mesh/grown_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <utility>

#include "core/geometry/distinct_points.h"
#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/surface/mesh/partial_mesh.h"

namespace instep {
namespace {

using Corner = PartialMesh::Corner;
using Triangle = PartialMesh::Triangle;

/// Neighbours among which an edge finds its third corner.
constexpr std::size_t kNeighbours = 20;
/// Third corners that an edge tries, the best first.
constexpr std::size_t kTried = 8;
/// Longest edge, against the spacing at its ends.
constexpr double kReach = 4.0;
/// Cosine of the sharpest bend between neighbouring triangles: 120 degrees.
constexpr double kSharpestBend = -0.5;
/// How much a bend weighs: a right angle counts as edges five times as long.
constexpr double kBendWeight = 4.0;
/// Sine of the narrowest angle of a triangle at a new corner, and of any angle of a seed triangle:
/// three points in a line tell no surface.
constexpr double kNarrowestAngle = 0.02;
constexpr double kNarrowestSeedAngle = 0.05;

/// A third corner for an edge. The misfit is the length of the two new edges, against what the
/// sampling round the edge lets expect, and heavier the more the surface would bend.
struct Candidate {
  Corner corner;
  double misfit;
};

/// An edge of the border, directed as in its triangle, with what is left to try beyond it.
struct BorderEdge {
  Corner from;
  Corner to;
  Corner behind;                      ///< third corner of its triangle
  std::vector<Candidate> candidates;  ///< the best is last
};

class Growth {
 public:
  explicit Growth(const std::vector<Eigen::Vector3d>& points)
      : points_(points), mesh_(points), collected_in_(points.size(), 0) {
    const PointIndex index(points);
    neighbours_.reserve(points.size());
    spacings_.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::vector<Corner> around;
      double squared = 0.0;
      for (const auto& found : index.nearest(points[i], kNeighbours + 1)) {
        if (found.index == i) continue;
        around.push_back(static_cast<Corner>(found.index));
        if (around.size() <= kSpacingNeighbours) squared = found.squared_distance;
      }
      spacings_.push_back(
          spacing_within(std::sqrt(squared), std::min(around.size(), kSpacingNeighbours)));
      neighbours_.push_back(std::move(around));
    }
  }

  const std::vector<Triangle>& run() {
    for (Corner corner = 0; corner < points_.size(); ++corner) {
      if (plant(corner)) grow();
    }
    grow_into_gaps();
    return mesh_.triangles();
  }

 private:
  /// A seed triangle far from what is there already: a point, the nearest to it, and the third that
  /// makes the widest triangle of them.
  bool plant(Corner corner) {
    const auto& around = neighbours_[corner];
    if (around.size() < 2 || mesh_.has_corner(corner)) return false;
    if (std::any_of(around.begin(), around.end(), [&](Corner c) { return mesh_.has_corner(c); })) {
      return false;
    }
    const auto width = [&](Corner third) { return narrowest_sine(corner, around.front(), third); };
    const Corner third =
        *std::max_element(around.begin() + 1, around.end(),
                          [&](Corner one, Corner other) { return width(one) < width(other); });
    if (!(width(third) > kNarrowestSeedAngle)) return false;
    add({corner, around.front(), third});
    return true;
  }

  double narrowest_sine(Corner a, Corner b, Corner c) const {
    const std::array<Eigen::Vector3d, 3> sides = {(points_[b] - points_[a]).normalized(),
                                                  (points_[c] - points_[b]).normalized(),
                                                  (points_[a] - points_[c]).normalized()};
    return std::min({sides[0].cross(sides[1]).norm(), sides[1].cross(sides[2]).norm(),
                     sides[2].cross(sides[0]).norm()});
  }

  void grow() {
    while (!queue_.empty()) {
      BorderEdge& edge = edges_[queue_.top().second];
      const std::size_t number = queue_.top().second;
      queue_.pop();
      if (mesh_.has_edge(edge.to, edge.from)) continue;
      const Triangle triangle{edge.to, edge.from, edge.candidates.back().corner};
      edge.candidates.pop_back();
      // Slivers that bend with the surface can seem to overlap what has room between three others.
      if (mesh_.is_hole(triangle) || mesh_.accepts(triangle, around(triangle))) {
        add(triangle);
      } else {
        wait(number);
      }
    }
  }

  /// The border may have come near to edges that found nothing in reach when they were new.
  void grow_into_gaps() {
    for (std::size_t number = 0; number < edges_.size(); ++number) {
      BorderEdge& edge = edges_[number];
      if (mesh_.has_edge(edge.to, edge.from)) continue;
      edge.candidates = candidates_of(edge.from, edge.to, edge.behind);
      wait(number);
    }
    grow();
  }

  void add(const Triangle& triangle) {
    mesh_.add(triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner from = triangle[k];
      const Corner to = triangle[(k + 1) % 3];
      if (mesh_.has_edge(to, from)) continue;
      const Corner behind = triangle[(k + 2) % 3];
      edges_.push_back({from, to, behind, candidates_of(from, to, behind)});
      wait(edges_.size() - 1);
    }
  }

  /// Puts an edge in the queue, if anything is left to try.
  void wait(std::size_t number) {
    auto& candidates = edges_[number].candidates;
    while (!candidates.empty() && mesh_.is_surrounded(candidates.back().corner)) {
      candidates.pop_back();
    }
    if (!candidates.empty()) queue_.emplace(candidates.back().misfit, number);
  }

  /// Each neighbour of some corners once; the corners themselves may be among them.
  std::vector<Corner> around(std::span<const Corner> corners) {
    ++round_;
    std::vector<Corner> found;
    const auto collect = [&](const std::vector<Corner>& more) {
      for (const Corner corner : more) {
        if (std::exchange(collected_in_[corner], round_) != round_) found.push_back(corner);
      }
    };
    for (const Corner corner : corners) {
      collect(neighbours_[corner]);
      collect(mesh_.border_at(corner));
    }
    return found;
  }

  /// Third corners beyond an edge whose triangle has its own third corner at `behind`.
  std::vector<Candidate> candidates_of(Corner from, Corner to, Corner behind) {
    const Eigen::Vector3d& a = points_[from];
    const Eigen::Vector3d& b = points_[to];
    const Eigen::Vector3d along = (b - a).normalized();
    const auto across = [&](Corner corner) -> Eigen::Vector3d {
      const Eigen::Vector3d offset = points_[corner] - a;
      return (offset - offset.dot(along) * along).normalized();
    };
    const Eigen::Vector3d ahead = -across(behind);
    const double reach = kReach * std::max(spacings_[from], spacings_[to]);
    std::vector<Candidate> candidates;
    const auto consider = [&](Corner corner) {
      if (corner == from || corner == to || mesh_.is_surrounded(corner)) return;
      const Eigen::Vector3d to_a = a - points_[corner];
      const Eigen::Vector3d to_b = b - points_[corner];
      const double length_a = to_a.norm();
      const double length_b = to_b.norm();
      if (std::max(length_a, length_b) > reach) return;
      if (to_a.cross(to_b).norm() < kNarrowestAngle * length_a * length_b) return;
      const double straight = ahead.dot(across(corner));
      if (straight < kSharpestBend) return;
      const double size = (length_a + length_b) / (spacings_[from] + spacings_[to]);
      candidates.push_back({corner, size * (1.0 + kBendWeight * (1.0 - straight))});
    };
    for (const Corner corner : around(std::array{from, to})) consider(corner);
    const auto suits_better = [](const Candidate& first, const Candidate& second) {
      return std::pair(first.misfit, first.corner) < std::pair(second.misfit, second.corner);
    };
    const std::size_t kept = std::min(candidates.size(), kTried);
    const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(kept);
    std::partial_sort(candidates.begin(), end, candidates.end(), suits_better);
    candidates.erase(end, candidates.end());
    std::reverse(candidates.begin(), candidates.end());
    return candidates;
  }

  const std::vector<Eigen::Vector3d>& points_;
  PartialMesh mesh_;
  std::vector<std::vector<Corner>> neighbours_;
  std::vector<double> spacings_;
  std::vector<std::uint32_t> collected_in_;  ///< round in which around() last met each corner
  std::uint32_t round_ = 0;
  std::vector<BorderEdge> edges_;
  using Turn = std::pair<double, std::size_t>;  ///< misfit, number of the edge
  std::priority_queue<Turn, std::vector<Turn>, std::greater<>> queue_;
};

}  // namespace

TriangleMesh grow_mesh(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Corner> used;
  std::vector<Eigen::Vector3d> places;
  for (const std::size_t corner : distinct_points(points)) {
    used.push_back(static_cast<Corner>(corner));
    places.push_back(points[corner]);
  }
  TriangleMesh mesh{points, {}};
  if (places.size() < 3) return mesh;
  Growth growth(places);
  for (const Triangle& triangle : growth.run()) {
    mesh.triangles.push_back({used[triangle[0]], used[triangle[1]], used[triangle[2]]});
  }
  return mesh;
}

}  // namespace instep
