#include "core/geometry/strays/loose_clumps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "core/geometry/moments.h"
#include "core/geometry/moments_round.h"
#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/geometry/quadratic_skin.h"
#include "core/geometry/voxel_grid.h"
#include "core/median.h"
#include "core/picked.h"
#include "core/stride.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Members = std::vector<std::size_t>;

/// A skin hangs together by the least; the others find clumps whose points lie further apart.
constexpr double kCellsInSpacings[] = {1.5, 3.0, 6.0};
constexpr std::size_t kFewest = 4;  ///< of fewer each stands alone
constexpr double kSmallShare = 0.002;
constexpr double kHeapShare = 0.02;
constexpr double kGapInSpacings = 2.0;
/// Of its size; what is larger may be a line of a scanner, as round a sole.
constexpr double kGapOfSize = 0.33;
/// As far apart are lines of a scanner on skin that lies aslant to them.
constexpr double kLeastGapMm = 6.0;
/// Of the skin before a gap, what is looked at, how well a quadratic surface fits it, and how far
/// off it what that skin reaches may be.
constexpr double kRoundInGaps = 2.0;
constexpr double kFitsInGaps = 0.1;
constexpr double kReachedInGaps = 0.3;
constexpr std::size_t kMostPieces = 6;  ///< of a skin with unseen strips
constexpr double kSkinShare = 0.98;     ///< of the points, that these hold

/// Points on whose dozen nearest a plane fits: few of a heap, most of a skin.
constexpr std::size_t kBeside = 12;
constexpr double kFlat = 0.4;  ///< spread across, over that along
constexpr double kFlatOfHeap = 0.33;
constexpr double kFlatOfSkin = 0.67;
constexpr std::size_t kAskedIfFlat = 200;

/// Points that hang together, by piece.
std::vector<Members> pieces_of(const std::vector<Vector3d>& points, double cell_mm) {
  const auto piece_of = VoxelGrid(points, cell_mm).clusters_of_points();
  std::vector<Members> pieces;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (piece_of[i] >= pieces.size()) pieces.resize(piece_of[i] + 1);
    pieces[piece_of[i]].push_back(i);
  }
  return pieces;
}

/// Whether a few large pieces are nearly all of it.
bool is_few_large_pieces(const std::vector<Members>& pieces, double small, std::size_t all) {
  std::size_t large = 0;
  std::size_t held = 0;
  for (const auto& piece : pieces) {
    if (static_cast<double>(piece.size()) < small) continue;
    ++large;
    held += piece.size();
  }
  return large <= kMostPieces && static_cast<double>(held) >= kSkinShare * static_cast<double>(all);
}

/// The median spacing of points by themselves.
double spacing_among(const PointIndex& clump) {
  std::vector<double> spacings;
  for (const auto& point : clump.points()) spacings.push_back(own_spacing(clump, point));
  return median(std::move(spacings));
}

/// Of some points, those on whose neighbours a plane fits.
double flat_share(const std::vector<Vector3d>& all, const Members& members) {
  const PointIndex index(picked(all, members));
  const auto& points = index.points();
  const std::size_t stride = stride_to_at_most(kAskedIfFlat, points.size());
  std::size_t asked = 0;
  std::size_t flat = 0;
  for (std::size_t i = 0; i < points.size(); i += stride, ++asked) {
    const auto beside = index.nearest(points[i], kBeside);
    flat += are_flat(moments_round(index, points[i], beside).axes(), kFlat * kFlat);
  }
  return static_cast<double>(flat) / static_cast<double>(asked);
}

/// Which of all points outside a clump is nearest to any of it, and how near.
PointIndex::Neighbour nearest_beyond(const PointIndex& clump, const Members& members,
                                     const Eigen::AlignedBox3d& box, const PointIndex& all) {
  PointIndex::Neighbour nearest{0, std::numeric_limits<double>::infinity()};
  const auto keep_nearer = [&](std::size_t index) {
    if (std::binary_search(members.begin(), members.end(), index)) return;
    const double squared = clump.nearest(all.points()[index], 1).front().squared_distance;
    if (std::tie(squared, index) < std::tie(nearest.squared_distance, nearest.index)) {
      nearest = {index, squared};
    }
  };
  const Vector3d middle = box.center();
  // By one more than the clump has; no further from its middle than this and its half lies any that
  // is nearer.
  for (const auto& one : all.nearest(middle, members.size() + 1)) keep_nearer(one.index);
  const double reach = std::sqrt(nearest.squared_distance) + 0.5 * box.diagonal().norm();
  constexpr double kRounded = 1.0 + 1e-9;
  for (const auto& one : all.around(middle, kRounded * reach)) keep_nearer(one.index);
  return nearest;
}

/// Points seen from a place, the third coordinate across the skin there.
struct View {
  Vector3d place;
  Eigen::Matrix3d axes;  ///< columns, that across the skin first

  Vector3d of(const Vector3d& point) const {
    const Vector3d seen = axes.transpose() * (point - place);
    return {seen[1], seen[2], seen[0]};
  }
};

/// The median distance from a surface along its heights.
double distance_from(const QuadraticSkin& surface, const SkinPatch& points) {
  std::vector<double> off;
  for (const auto& point : points) {
    off.push_back(std::abs(point.z() - surface.at(point.x(), point.y())));
  }
  return median(std::move(off));
}

/// Whether skin bends on to a clump across the gap before it, as a tip does beyond the last but one
/// of the lines of a scanner.
bool is_reached(const Members& clump, const PointIndex::Neighbour& nearest, const PointIndex& all) {
  const Vector3d& place = all.points()[nearest.index];
  const double gap = std::sqrt(nearest.squared_distance);
  std::vector<Vector3d> skin;
  Moments moments;
  for (const auto& one : all.around(place, kRoundInGaps * gap)) {
    if (std::binary_search(clump.begin(), clump.end(), one.index)) continue;
    skin.push_back(all.points()[one.index]);
    moments.add(skin.back() - place);
  }
  const View view{place, moments.axes().eigenvectors()};
  const auto seen = [&](std::vector<Vector3d> points) {
    for (auto& point : points) point = view.of(point);
    return points;
  };
  const SkinPatch patch = seen(std::move(skin));
  const auto surface = QuadraticSkin::through(patch);
  return surface && distance_from(*surface, patch) < kFitsInGaps * gap &&
         distance_from(*surface, seen(picked(all.points(), clump))) < kReachedInGaps * gap;
}

bool is_loose(const Members& members, const PointIndex& all) {
  const PointIndex clump(picked(all.points(), members));
  Eigen::AlignedBox3d box;
  for (const auto& point : clump.points()) box.extend(point);
  const double least_gap = std::max(kGapOfSize * box.diagonal().norm(), kLeastGapMm);
  // So of most: skin that is seen sparsely at a side comes in thousands of small pieces.
  const bool has_others_near =
      all.around(clump.points().front(), least_gap).size() > members.size();
  if (has_others_near) return false;
  const auto beyond = nearest_beyond(clump, members, box, all);
  const double spacing =
      std::max(spacing_among(clump), own_spacing(all, all.points()[beyond.index]));
  return std::sqrt(beyond.squared_distance) > std::max(kGapInSpacings * spacing, least_gap) &&
         !is_reached(members, beyond, all);
}

/// A skin, and what is too little of it, or too thick, to be a part of it.
struct SkinAndClumps {
  std::vector<Members> skin;
  std::vector<Members> clumps;
  std::vector<Members> heaps;
};

SkinAndClumps skin_and_clumps(const std::vector<Vector3d>& points, double cell_mm) {
  SkinAndClumps found;
  auto pieces = pieces_of(points, cell_mm);
  const auto all = static_cast<double>(points.size());
  if (!is_few_large_pieces(pieces, kSmallShare * all, points.size())) return found;
  for (auto& piece : pieces) {
    const auto size = static_cast<double>(piece.size());
    if (size < kSmallShare * all) {
      if (piece.size() >= kFewest) found.clumps.push_back(std::move(piece));
    } else if (size < kHeapShare * all && flat_share(points, piece) < kFlatOfHeap) {
      found.heaps.push_back(std::move(piece));
    } else {
      found.skin.push_back(std::move(piece));
    }
  }
  return found;
}

/// Where noise is as large as the spacing, no skin is flat.
bool is_flat(const std::vector<Members>& skin, const std::vector<Vector3d>& points) {
  const auto larger = [](const Members& a, const Members& b) { return a.size() < b.size(); };
  const auto largest = std::max_element(skin.begin(), skin.end(), larger);
  return largest != skin.end() && flat_share(points, *largest) > kFlatOfSkin;
}

/// Clumps at some size of cells, whether or not something reaches them.
std::vector<Members> clumps_among(const std::vector<Vector3d>& points, double cell_mm) {
  auto found = skin_and_clumps(points, cell_mm);
  if (!found.heaps.empty() && is_flat(found.skin, points)) {
    std::move(found.heaps.begin(), found.heaps.end(), std::back_inserter(found.clumps));
  }
  return std::move(found.clumps);
}

}  // namespace

std::vector<bool> loose_clumps(const std::vector<Vector3d>& points, double spacing) {
  std::vector<bool> loose(points.size(), false);
  std::optional<PointIndex> all;
  for (const double cell : kCellsInSpacings) {
    for (const auto& clump : clumps_among(points, cell * spacing)) {
      if (!all) all.emplace(points);
      if (loose[clump.front()] || !is_loose(clump, *all)) continue;
      for (const std::size_t point : clump) loose[point] = true;
    }
  }
  return loose;
}

}  // namespace instep
