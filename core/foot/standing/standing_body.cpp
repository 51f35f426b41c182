#include "core/foot/standing/standing_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/foot/standing/things_beside.h"
#include "core/geometry/principal_frame.h"
#include "core/geometry/voxel_grid.h"
#include "core/median.h"

namespace instep {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kLeastLinkMm = 8.0;
constexpr double kPartShare = 0.25;        ///< of the largest piece, from which on one is a part
constexpr double kFewPointsShare = 0.002;  ///< a piece smaller than this is a handful of strays
constexpr double kBesideMm = 15.0;         ///< as far outside the box a piece may lie
constexpr double kBeyondBoxShare = 0.02;   ///< of the points, to each side of the box of most

/// Points spread over a body about as large as the box of most of them lie this far apart; a stray
/// may be metres away.
double rough_spacing(const std::vector<Vector3d>& points) {
  double squared = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> places;
    for (const auto& point : points) places.push_back(point(axis));
    const double from = quantile(places, kBeyondBoxShare);
    squared += std::pow(quantile(std::move(places), 1.0 - kBeyondBoxShare) - from, 2);
  }
  return std::sqrt(squared / static_cast<double>(points.size()));
}

/// The box of a piece along its own principal axes, however it lies in the cloud, and some more: a
/// side that was seen apart from the rest lies beside the others.
struct TurnedBox {
  RigidTransform box_from_cloud;
  AlignedBox3d box;

  explicit TurnedBox(const std::vector<Vector3d>& points)
      : box_from_cloud(principal_from_input(points)) {
    for (const auto& point : points) box.extend(box_from_cloud * point);
    box.min().array() -= kBesideMm;
    box.max().array() += kBesideMm;
  }

  bool holds_middle_of(const std::vector<Vector3d>& piece) const {
    AlignedBox3d own;
    for (const auto& point : piece) own.extend(box_from_cloud * point);
    return box.contains(own.center());
  }
};

using Piece = std::vector<Vector3d>;

/// Takes away what stands near, before the skin.
void part_from_things(StandingBody& body, const std::vector<Vector3d>& points, bool is_one_foot) {
  std::vector<Vector3d> places;
  places.reserve(body.points.size());
  for (const std::size_t point : body.points) places.push_back(points[point]);
  const ThingsBeside things = things_beside(places, is_one_foot ? kPartShare : 1.0);
  std::vector<std::size_t> left;
  left.reserve(body.points.size());
  auto thing = things.points.begin();
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    if (thing != things.points.end() && *thing == i) {
      ++thing;
    } else {
      left.push_back(body.points[i]);
    }
  }
  body.points = std::move(left);
  body.gap_beside_mm = things.gap_mm;
  body.beside_share = things.share;
  body.is_gap_seen = things.is_gap_seen;
}

}  // namespace

StandingBody standing_body(const std::vector<Vector3d>& points, bool is_one_foot) {
  StandingBody body;
  if (points.empty()) return body;
  const VoxelGrid grid(points, std::max(kLeastLinkMm, 2.0 * rough_spacing(points)));
  const auto piece_of = grid.clusters_of_points();
  std::vector<Piece> pieces(1 + *std::max_element(piece_of.begin(), piece_of.end()));
  for (std::size_t i = 0; i < points.size(); ++i) pieces[piece_of[i]].push_back(points[i]);
  const auto largest =
      std::max_element(pieces.begin(), pieces.end(),
                       [](const Piece& a, const Piece& b) { return a.size() < b.size(); });
  const TurnedBox box(*largest);
  const auto few = kFewPointsShare * static_cast<double>(points.size());
  const auto share_of = [&](const Piece& piece) {
    return static_cast<double>(piece.size()) / static_cast<double>(largest->size());
  };
  const auto is_part = [&](const Piece& piece) {
    return is_one_foot && share_of(piece) >= kPartShare;
  };
  std::vector<bool> belongs;
  for (const auto& piece : pieces) {
    const bool is_within = static_cast<double>(piece.size()) > few && box.holds_middle_of(piece);
    belongs.push_back(&piece == &*largest || is_part(piece) || is_within);
    if (&piece != &*largest && is_part(piece)) ++body.parts;
    if (!belongs.back()) body.next_share = std::max(body.next_share, share_of(piece));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (belongs[piece_of[i]]) body.points.push_back(i);
  }
  part_from_things(body, points, is_one_foot);
  body.apart_share =
      1.0 - static_cast<double>(body.points.size()) / static_cast<double>(points.size());
  return body;
}

}  // namespace instep
