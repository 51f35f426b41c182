#include "core/geometry/coordinate_step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/stride.h"

namespace instep {
namespace {

constexpr std::size_t kMostPoints = 4000;
/// Of a step: rounding of binary numbers.
constexpr double kOff = 1e-3;
/// Numbers as near to each other, against the largest, are the same.
constexpr double kSame = 1e-12;

/// Ascending.
double step_of(const std::vector<double>& sorted) {
  const double same = kSame * std::max(std::abs(sorted.front()), std::abs(sorted.back()));
  double step = 0.0;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double gap = sorted[i] - sorted[i - 1];
    if (gap > same && (step == 0.0 || gap < step)) step = gap;
  }
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double steps = (sorted[i] - sorted[i - 1]) / step;
    if (std::abs(steps - std::round(steps)) > kOff) return 0.0;
  }
  return step;
}

}  // namespace

double coordinate_step(const std::vector<Eigen::Vector3d>& points) {
  double coarsest = 0.0;
  const std::size_t stride = stride_to_at_most(kMostPoints, points.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (std::size_t i = 0; i < points.size(); i += stride) along.push_back(points[i][axis]);
    if (along.empty()) return 0.0;
    std::sort(along.begin(), along.end());
    coarsest = std::max(coarsest, step_of(along));
  }
  return coarsest;
}

}  // namespace instep
