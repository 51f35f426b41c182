#include "core/foot/standing_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/geometry/voxel_grid.h"

namespace instep {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kLeastLinkMm = 8.0;
constexpr double kPartShare = 0.25;        ///< of the largest piece, from which on one is a part
constexpr double kFewPointsShare = 0.002;  ///< a piece smaller than this is a handful of strays

/// Points spread over a body about as large as their box lie this far apart.
double rough_spacing(const std::vector<Vector3d>& points) {
  AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  return box.diagonal().norm() / std::sqrt(static_cast<double>(points.size()));
}

struct Piece {
  std::size_t points = 0;
  AlignedBox3d box;
};

}  // namespace

StandingBody standing_body(const std::vector<Vector3d>& points, bool is_one_foot) {
  StandingBody body;
  if (points.empty()) return body;
  const VoxelGrid grid(points, std::max(kLeastLinkMm, 2.0 * rough_spacing(points)));
  const auto piece_of = grid.clusters_of_points();
  std::vector<Piece> pieces(1 + *std::max_element(piece_of.begin(), piece_of.end()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    ++pieces[piece_of[i]].points;
    pieces[piece_of[i]].box.extend(points[i]);
  }
  const auto largest =
      std::max_element(pieces.begin(), pieces.end(),
                       [](const Piece& a, const Piece& b) { return a.points < b.points; });
  const auto few = kFewPointsShare * static_cast<double>(points.size());
  const auto is_part = [&](const Piece& piece) {
    return is_one_foot &&
           static_cast<double>(piece.points) >= kPartShare * static_cast<double>(largest->points);
  };
  const auto belongs = [&](const Piece& piece) {
    return &piece == &*largest || is_part(piece) ||
           (static_cast<double>(piece.points) > few && largest->box.contains(piece.box.center()));
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (belongs(pieces[piece_of[i]])) body.points.push_back(i);
  }
  for (const auto& piece : pieces) {
    if (&piece != &*largest && is_part(piece)) ++body.parts;
    if (belongs(piece)) continue;
    body.next_share = std::max(
        body.next_share, static_cast<double>(piece.points) / static_cast<double>(largest->points));
  }
  body.apart_share =
      1.0 - static_cast<double>(body.points.size()) / static_cast<double>(points.size());
  return body;
}

}  // namespace instep
