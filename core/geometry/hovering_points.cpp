#include "core/geometry/hovering_points.h"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/geometry/moments.h"
#include "core/geometry/stray_points.h"

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

/// Whether a place is above the skin, and not beside it.
bool is_above(const PointIndex& skin, const Eigen::Vector3d& place) {
  const std::size_t below = skin.nearest(place, 1).front().index;
  const Eigen::Vector3d& foot = skin.points()[below];
  Moments moments;
  for (const auto& one : skin.nearest(foot, kBelow)) {
    // Itself may be a stray near the skin.
    if (one.index != below) moments.add(skin.points()[one.index] - foot);
  }
  const Eigen::Vector3d arm = place - foot;
  return std::abs(moments.flattest().dot(arm)) > kStraightAbove * arm.norm();
}

/// Whether a point that stands far apart has others such beside it on a sheet. `own`: its spacing.
bool is_on_sheet(const PointIndex& far_apart, const Eigen::Vector3d& place, double own) {
  const auto beside = far_apart.nearest(place, kBeside);
  if (beside.size() < kBeside) return false;
  if (own_spacing(far_apart, place) > kBesideDenser * own) return false;
  Moments moments;
  for (const auto& one : beside) moments.add(far_apart.points()[one.index] - place);
  const Eigen::Vector3d spreads = moments.axes().eigenvalues();
  return spreads[0] < kFlat * kFlat * spreads[1];
}

}  // namespace

std::vector<bool> hovering_points(const PointIndex& index, double spacing) {
  const auto& points = index.points();
  std::vector<double> own;
  std::vector<Eigen::Vector3d> close;
  std::vector<Eigen::Vector3d> far;
  for (const auto& point : points) {
    own.push_back(own_spacing(index, point));
    (own.back() > kFarApart * spacing ? far : close).push_back(point);
  }
  std::vector<bool> hovering(points.size(), false);
  if (close.size() < kBelow || far.empty()) return hovering;
  const PointIndex skin(std::move(close));
  const PointIndex far_apart(std::move(far));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (own[i] <= kFarApart * spacing) continue;
    hovering[i] = is_above(skin, points[i]) && !is_on_sheet(far_apart, points[i], own[i]);
  }
  return hovering;
}

}  // namespace instep
