#include "core/surface/tangent_view.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

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
/// So many times as far as the nearest ones lie some eight times as many.
constexpr double kWider = 2.83;

/// `nearest`: to its middle, in that order.
TangentView tangent_view(const std::vector<Eigen::Vector3d>& points,
                         std::span<const PointIndex::Neighbour> nearest) {
  TangentView view;
  const std::size_t count = std::min(nearest.size(), kMostInView);
  view.points.resize(3, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t chosen = nearest[i * nearest.size() / count].index;
    view.points.col(static_cast<Eigen::Index>(i)) = points[chosen];
  }
  view.points.colwise() -= view.points.rowwise().mean().eval();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(view.points * view.points.transpose());
  view.points = axes.eigenvectors().rowwise().reverse().transpose() * view.points;
  const Eigen::Vector3d spread = axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (spread[1] > 0.0) view.thickness = spread[0] / spread[1];
  return view;
}

/// Whether the view of so many of the nearest is flat enough, for one of the counts; the flattest
/// of those looked at goes into `best`.
bool find_flat_view(const std::vector<Eigen::Vector3d>& points,
                    std::span<const PointIndex::Neighbour> nearest,
                    std::span<const std::size_t> counts, TangentView& best) {
  for (const std::size_t count : counts) {
    TangentView view = tangent_view(points, nearest.first(std::min(count, nearest.size())));
    if (view.thickness < best.thickness) best = std::move(view);
    if (best.thickness <= kFlatEnough) return true;
  }
  return false;
}

}  // namespace

double TangentView::spacing() const {
  return radius() * std::sqrt(std::numbers::pi / static_cast<double>(points.cols()));
}

TangentView flattest_view(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
                          const Eigen::Vector3d& centre) {
  TangentView best;
  const auto nearest = index.nearest(centre, kNearest);
  const double reach = std::sqrt(nearest.back().squared_distance);
  if (!find_flat_view(points, nearest, kTriedFirst, best)) {
    // Within a radius many are found far quicker than one by one.
    find_flat_view(points, index.within(centre, kWider * reach), kTriedThen, best);
  }
  best.crowded = reach <= kCrowdedReach;
  return best;
}

}  // namespace instep
