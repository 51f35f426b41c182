#include "core/geometry/distinct_points.h"

#include <algorithm>
#include <tuple>

namespace instep {

std::vector<std::size_t> distinct_points(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::tuple<double, double, double, std::size_t>> sorted;
  sorted.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    sorted.emplace_back(points[i].x(), points[i].y(), points[i].z(), i);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> repeats(points.size(), false);
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    const auto previous = std::get<3>(sorted[k - 1]);
    const auto index = std::get<3>(sorted[k]);
    repeats[index] = points[index] == points[previous];
  }
  std::vector<std::size_t> firsts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!repeats[i]) firsts.push_back(i);
  }
  return firsts;
}

}  // namespace instep
