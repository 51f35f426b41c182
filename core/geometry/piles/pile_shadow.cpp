#include "core/geometry/piles/pile_shadow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "core/geometry/moments.h"
#include "core/geometry/point_index.h"

namespace instep {
namespace {

/// In sides: nearer than this is what scatters round the pile.
constexpr double kOffPile = 1.0;
/// Half as wide as a cell's diagonal, and wider further off, for cameras do not look straight.
constexpr double kHalfWidth = 0.7;
constexpr double kWidening = 0.5;
/// In sides: who is so near is company; and the part of what a skin has that is too little.
constexpr double kCompany = 2.0;
constexpr double kLonely = 0.5;
/// Of the variances across a skin and along it.
constexpr double kFlat = 0.3;

/// `arm`: from the face, in sides.
bool is_before_or_behind(const PileFace& face, const Eigen::Vector3d& arm) {
  const double height = std::abs(arm.dot(face.normal));
  const double aside = std::sqrt(std::max(0.0, arm.squaredNorm() - height * height));
  return height > kOffPile && aside < kHalfWidth + kWidening * height;
}

/// Has as many points round it as there are of a skin, and they lie as flat.
bool is_of_skin(const Eigen::Vector3d& point, const PointIndex& index, const PileLevel& level) {
  const auto company = index.around(point, kCompany * level.side);
  const double usual = std::numbers::pi * kCompany * kCompany * level.usual;
  if (static_cast<double>(company.size()) < kLonely * usual) return false;
  Moments moments;
  for (const auto& near : company) moments.add((index.points()[near.index] - point) / level.side);
  return are_flat(moments.axes(), kFlat);
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
  std::vector<bool> of_skin(numbers.size(), false);
  for (const auto& face : faces) {
    for (const auto& near : index.around(face.place, level.shadow)) {
      if (marked[numbers[near.index]] || of_skin[near.index]) continue;
      const Eigen::Vector3d& point = index.points()[near.index];
      if (!is_before_or_behind(face, (point - face.place) / level.side)) continue;
      if (is_of_skin(point, index, level)) {
        of_skin[near.index] = true;
      } else {
        marked[numbers[near.index]] = true;
      }
    }
  }
}

}  // namespace instep
