#include "core/geometry/point_spacing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/median.h"
#include "core/stride.h"

namespace instep {
namespace {

/// The median of what `measure` says of some `sample` points; zero if no point has another.
template <typename Measure>
double median_over(const PointIndex& index, std::size_t sample, const Measure& measure) {
  const auto& points = index.points();
  if (points.size() < 2 || sample == 0) return 0.0;
  std::vector<double> measures;
  const std::size_t stride = stride_to_at_least(sample, points.size());
  for (std::size_t i = 0; i < points.size(); i += stride) measures.push_back(measure(points[i]));
  return median(std::move(measures));
}

}  // namespace

double spacing_within(double reach, std::size_t count) {
  return reach * std::sqrt(std::numbers::pi / static_cast<double>(std::max<std::size_t>(count, 1)));
}

double own_spacing(const std::vector<PointIndex::Neighbour>& nearest) {
  return spacing_within(std::sqrt(nearest.back().squared_distance), nearest.size() - 1);
}

double own_spacing(const PointIndex& index, const Eigen::Vector3d& point) {
  return own_spacing(index.nearest(point, kSpacingNeighbours + 1));
}

double usual_spacing(const PointIndex& index, std::size_t sample) {
  return median_over(index, sample,
                     [&](const Eigen::Vector3d& point) { return own_spacing(index, point); });
}

double median_nearest_distance(const PointIndex& index) {
  constexpr std::size_t kSample = 2000;
  return median_over(index, kSample, [&](const Eigen::Vector3d& point) {
    return std::sqrt(index.nearest(point, 2).back().squared_distance);
  });
}

}  // namespace instep
