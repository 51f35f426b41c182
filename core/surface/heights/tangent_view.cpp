#include "core/surface/heights/tangent_view.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "core/geometry/point_spacing.h"
#include "core/surface/heights/opposite_walls.h"

namespace instep {
namespace {

/// A view whose thickness is at most this part of its width is flat enough. One that is not is
/// taken larger, where noise is thicker than the spacing, or smaller, where it bends too much or
/// reaches across a thin part; the flattest counts.
constexpr double kFlatEnough = 0.15;
constexpr std::size_t kNearest = 60;
constexpr std::array<std::size_t, 3> kTriedFirst = {kNearest, 30, 20};
constexpr std::array<std::size_t, 3> kTriedThen = {120, 240, 480};
/// The nearest ones of a crowd reach no further.
constexpr double kCrowdedReach = 0.05;
/// So many times as far as some lie eight times as many.
constexpr double kWider = 2.83;
constexpr std::size_t kMoreWithin = 8;
/// Where the views of a crowd are thicker than this, and the widest of them is the flattest, or
/// none is flatter than a ball by more than that, noise may be thicker than they are wide: wider
/// ones are tried up to this reach.
constexpr double kHardlyFlat = 0.3;
constexpr double kNearlyABall = 0.42;
constexpr double kWidestReach = 0.3;
/// Cosine to the direction from the middle: of the walls at the tip of a wedge of 60 degrees a
/// half.
constexpr double kFacesMiddle = 0.6;
/// Of more an even part is put in order.
constexpr std::size_t kMostInOrder = 8000;

/// `nearest`: to its middle, in that order.
TangentView tangent_view(const std::vector<Eigen::Vector3d>& points,
                         std::span<const PointIndex::Neighbour> nearest) {
  TangentView view;
  const std::size_t count = std::min(nearest.size(), kMostInView);
  view.points.resize(3, static_cast<Eigen::Index>(count));
  view.indices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t chosen = nearest[i * nearest.size() / count].index;
    view.points.col(static_cast<Eigen::Index>(i)) = points[chosen];
    view.indices.push_back(chosen);
  }
  view.points.colwise() -= view.points.rowwise().mean().eval();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(view.points * view.points.transpose());
  view.points = axes.eigenvectors().rowwise().reverse().transpose() * view.points;
  const Eigen::Vector3d spread = axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (spread[1] > 0.0) view.thickness = spread[0] / spread[1];
  return view;
}

/// The flattest view of those that were looked at.
struct Flattest {
  TangentView view;
  bool is_widest = false;  ///< of them

  bool is_enough() const { return view.thickness <= kFlatEnough; }
  bool may_be_all_noise() const {
    return view.thickness > (is_widest ? kHardlyFlat : kNearlyABall);
  }
};

/// Looks at so many of the nearest, until a view is flat enough.
void look(const std::vector<Eigen::Vector3d>& points,
          std::span<const PointIndex::Neighbour> nearest, std::span<const std::size_t> counts,
          Flattest& best) {
  for (const std::size_t count : counts) {
    if (best.is_enough()) return;
    TangentView view = tangent_view(points, nearest.first(std::min(count, nearest.size())));
    best.is_widest = view.thickness < best.view.thickness;
    if (best.is_widest) best.view = std::move(view);
  }
}

/// Of those that lie on the same wall of a thin part as the nearest one. Walls that face to the
/// middle of the body or away from it may be two layers of one skin: none of these.
std::vector<PointIndex::Neighbour> on_one_wall(const std::vector<Eigen::Vector3d>& points,
                                               const std::vector<PointIndex::Neighbour>& nearest) {
  std::vector<Eigen::Vector3d> places;
  for (const auto& one : nearest) places.push_back(points[one.index]);
  const auto walls = OppositeWalls::among(places);
  std::vector<PointIndex::Neighbour> same;
  if (!walls) return same;
  const auto side = walls->sides.front();
  const Eigen::Vector2d arm = places.front().head<2>();
  if (std::abs(walls->both[side].normal.head<2>().dot(arm)) > kFacesMiddle * arm.norm())
    return same;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (walls->sides[i] == side) same.push_back(nearest[i]);
  }
  return same;
}

/// As many of the nearest as lie within reach, nearest first.
struct Nearest {
  std::vector<PointIndex::Neighbour> some;  ///< of very many every so many-th
  std::size_t one_in = 1;
};

Nearest nearest_within(const PointIndex& index, const Eigen::Vector3d& centre, double reach) {
  Nearest nearest{index.around(centre, reach)};
  auto& some = nearest.some;
  nearest.one_in = 1 + some.size() / kMostInOrder;
  for (std::size_t i = 0; i * nearest.one_in < some.size(); ++i) some[i] = some[i * nearest.one_in];
  some.resize((some.size() + nearest.one_in - 1) / nearest.one_in);
  std::sort(some.begin(), some.end(), [](const auto& a, const auto& b) {
    return std::pair(a.squared_distance, a.index) < std::pair(b.squared_distance, b.index);
  });
  return nearest;
}

}  // namespace

double TangentView::spacing() const {
  return spacing_within(radius(), static_cast<std::size_t>(points.cols()));
}

TangentView flattest_view(const PointIndex& index, const Eigen::Vector3d& centre) {
  const auto& points = index.points();
  Flattest best;
  const auto nearest = index.nearest(centre, kNearest);
  const double reach = std::sqrt(nearest.back().squared_distance);
  look(points, nearest, kTriedFirst, best);
  if (!best.is_enough()) {
    const auto wall = on_one_wall(points, nearest);
    const std::array<std::size_t, 1> all = {wall.size()};
    if (!wall.empty()) look(points, wall, all, best);
  }
  const bool crowded = reach <= kCrowdedReach;
  // Within a radius many are found far quicker than one by one.
  double wide = kWider * reach;
  std::size_t times = 1;
  while (!best.is_enough() && wide > 0.0) {
    const auto [some, one_in] = nearest_within(index, centre, wide);
    std::vector<std::size_t> counts;
    for (const std::size_t count : kTriedThen) {
      counts.push_back(std::max(count * times / one_in, kNearest));
      if (counts.back() >= some.size()) break;
    }
    look(points, some, counts, best);
    if (!crowded || !best.may_be_all_noise() || wide >= kWidestReach) break;
    wide = std::min(kWider * wide, kWidestReach);
    times = std::min(kMoreWithin * times, points.size());
  }
  best.view.crowded = crowded;
  return std::move(best.view);
}

}  // namespace instep
