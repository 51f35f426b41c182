#include "core/geometry/pile_shadow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "core/geometry/point_index.h"

namespace instep {
namespace {

/// In sides: nearer than this is what scatters round the pile.
constexpr double kOffPile = 1.0;
/// Half as wide as a cell's diagonal, and wider further off, for cameras do not look straight.
constexpr double kHalfWidth = 0.7;
constexpr double kWidening = 0.5;
/// Of the shadow.
constexpr double kHalfShade = 3.0;
constexpr double kLonely = 0.5;

/// `arm`: from the face, in sides.
bool is_before_or_behind(const PileFace& face, const Eigen::Vector3d& arm) {
  const double height = std::abs(arm.dot(face.normal));
  const double aside = std::sqrt(std::max(0.0, arm.squaredNorm() - height * height));
  return height > kOffPile && aside < kHalfWidth + kWidening * height;
}

/// Has fewer points round it than a skin.
bool is_lonely(const Eigen::Vector3d& point, const PointIndex& index, const PileLevel& level) {
  const auto company = static_cast<double>(index.around(point, level.side).size());
  return company < kLonely * std::numbers::pi * level.usual;
}

}  // namespace

void mark_shadows(const std::vector<Eigen::Vector3d>& points, const std::vector<PileFace>& faces,
                  const PileLevel& level, std::vector<bool>& marked) {
  std::vector<Eigen::Vector3d> others;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (marked[i]) continue;
    others.push_back(points[i]);
    numbers.push_back(i);
  }
  if (others.empty()) return;
  const PointIndex index(std::move(others));
  for (const auto& face : faces) {
    for (const auto& near : index.around(face.place, kHalfShade * level.shadow)) {
      if (marked[numbers[near.index]]) continue;
      const Eigen::Vector3d& point = index.points()[near.index];
      if (!is_before_or_behind(face, (point - face.place) / level.side)) continue;
      const bool in_shadow = near.squared_distance <= level.shadow * level.shadow;
      if (in_shadow || is_lonely(point, index, level)) marked[numbers[near.index]] = true;
    }
  }
}

}  // namespace instep
