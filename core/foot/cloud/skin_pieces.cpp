#include "core/foot/cloud/skin_pieces.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/disjoint_sets.h"
#include "core/geometry/moments.h"
#include "core/geometry/moments_round.h"
#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// That tell how densely a place was seen and how the skin lies there.
constexpr std::size_t kNeighbours = 16;
constexpr double kReach = 2.0;
constexpr double kLeastReach = 1.4;
constexpr double kAlong = 0.55;  ///< sine of the way from place to place to the skin, at most

}  // namespace

SkinPieces::SkinPieces(const std::vector<Vector3d>& points)
    : points_(points), normals_(points.size()) {
  if (points.empty()) return;
  const PointIndex index(points);
  std::vector<double> spacings;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto nearest = index.nearest(points[i], kNeighbours + 1);
    spacings.push_back(own_spacing(nearest));
    for (const auto& other : nearest) {
      pairs_.push_back({i, other.index, std::sqrt(other.squared_distance)});
    }
    const SpreadAxes axes = moments_round(index, points[i], nearest).axes();
    if (lies_as_skin(axes)) normals_[i] = axes.eigenvectors().col(0);
  }
  for (auto& pair : pairs_) {
    const double spacing = std::max(spacings[pair.one], spacings[pair.other]);
    if (spacing > 0.0) pair.spacings /= spacing;
  }
  usual_spacing_ = median(std::move(spacings));
}

SkinPieces::Pieces SkinPieces::within_reach() const {
  return pieces_by([](const Pair& pair) { return pair.spacings <= kReach; });
}

SkinPieces::Pieces SkinPieces::within_least_reach() const {
  return pieces_by([](const Pair& pair) { return pair.spacings <= kLeastReach; });
}

SkinPieces::Pieces SkinPieces::along_skin() const {
  return pieces_by([this](const Pair& pair) { return pair.spacings <= kReach && is_along(pair); });
}

template <typename Joins>
SkinPieces::Pieces SkinPieces::pieces_by(const Joins& joins) const {
  DisjointSets sets(points_.size());
  for (const auto& pair : pairs_) {
    if (joins(pair)) sets.join(pair.one, pair.other);
  }
  const auto numbers = sets.numbers();
  Pieces pieces(sets.count());
  for (std::size_t i = 0; i < points_.size(); ++i) pieces[numbers[i]].push_back(i);
  return pieces;
}

bool SkinPieces::is_along(const Pair& pair) const {
  const auto& one = normals_[pair.one];
  const auto& other = normals_[pair.other];
  if (!one || !other) return false;
  const Vector3d way = points_[pair.other] - points_[pair.one];
  const double most = kAlong * way.norm();
  return std::abs(one->dot(way)) <= most && std::abs(other->dot(way)) <= most;
}

}  // namespace instep
