#include "core/geometry/strays/hovering_points.h"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/geometry/moments.h"
#include "core/geometry/moments_round.h"
#include "core/geometry/point_spacing.h"
#include "core/picked.h"

namespace instep {
namespace {

/// Own spacing of points that stand far apart, against that of most: as of points that stand alone
/// against that of their neighbours.
constexpr double kFarApart = 2.2;
/// Of the skin: they tell its normal.
constexpr std::size_t kBelow = 12;
/// Cosine to that normal.
constexpr double kStraightAbove = 0.7;
/// Of those that stand far apart, itself included: they tell whether it lies on a sheet.
constexpr std::size_t kBeside = 9;
/// How far a sheet spreads across itself, against along.
constexpr double kFlat = 0.2;
/// How much further off the points of a sheet are than all neighbours: beside denser skin these are
/// of that.
constexpr double kBesideDenser = 2.0;
/// What is further above the skin than so many own spacings may be beyond a bend of it.
constexpr double kReach = 4.0;
/// Strays hide each other: those above them stand further apart without them.
constexpr int kMostRounds = 8;
/// Of the points: more that stand far apart are a skin of their own, less densely seen.
constexpr double kMostStrays = 0.2;

/// Whether a place is above the skin, and not beside it nor further than `reach`.
bool is_above(const PointIndex& skin, const Eigen::Vector3d& place, double reach) {
  const std::size_t below = skin.nearest(place, 1).front().index;
  const Eigen::Vector3d& foot = skin.points()[below];
  const Eigen::Vector3d arm = place - foot;
  if (arm.norm() > reach) return false;
  Moments moments;
  for (const auto& one : skin.nearest(foot, kBelow)) {
    // Itself may be a stray near the skin.
    if (one.index != below) moments.add(skin.points()[one.index] - foot);
  }
  return std::abs(moments.flattest().dot(arm)) > kStraightAbove * arm.norm();
}

/// Whether a point that stands far apart has others such beside it on a sheet. `own`: its spacing.
bool is_on_sheet(const PointIndex& far_apart, const Eigen::Vector3d& place, double own) {
  const auto beside = far_apart.nearest(place, kBeside);
  if (beside.size() < kBeside) return false;
  if (own_spacing(far_apart, place) > kBesideDenser * own) return false;
  return are_flat(moments_round(far_apart, place, beside).axes(), kFlat * kFlat);
}

}  // namespace

std::vector<bool> hovering_points(const PointIndex& index, double spacing) {
  const auto& points = index.points();
  const std::size_t count = points.size();
  std::vector<std::size_t> close;
  std::vector<std::size_t> far;
  for (std::size_t i = 0; i < count; ++i) {
    (own_spacing(index, points[i]) > kFarApart * spacing ? far : close).push_back(i);
  }
  std::vector<bool> hovering(count, false);
  if (close.size() < kBelow) return hovering;
  if (static_cast<double>(far.size()) > kMostStrays * static_cast<double>(count)) return hovering;
  const PointIndex skin(picked(points, close));
  for (int round = 0; round < kMostRounds && !far.empty(); ++round) {
    const PointIndex far_apart(picked(points, far));
    auto rest = skin.points();
    rest.insert(rest.end(), far_apart.points().begin(), far_apart.points().end());
    const PointIndex all(std::move(rest));
    const auto found = std::erase_if(far, [&](std::size_t point) {
      const Eigen::Vector3d& place = points[point];
      const double own = own_spacing(all, place);
      hovering[point] = is_above(skin, place, kReach * own) && !is_on_sheet(far_apart, place, own);
      return hovering[point];
    });
    if (found == 0) break;
  }
  return hovering;
}

}  // namespace instep
