#include "core/geometry/hovering_points.h"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "core/geometry/moments.h"
#include "core/geometry/stray_points.h"

namespace instep {
namespace {

constexpr std::size_t kNeighbours = 12;
/// Own spacing of points that stand far apart, against that of most.
constexpr double kFarApart = 2.2;
/// What is further above the skin than so many own spacings may be beyond a bend of it.
constexpr double kReach = 4.0;
/// Cosine to the normal of the skin below.
constexpr double kStraightAbove = 0.7;

/// Of those round a point; without itself, which may be a stray near the skin.
Eigen::Vector3d normal_at(const PointIndex& skin, std::size_t point) {
  const Eigen::Vector3d& place = skin.points()[point];
  Moments moments;
  for (const auto& one : skin.nearest(place, kNeighbours)) {
    if (one.index != point) moments.add(skin.points()[one.index] - place);
  }
  return moments.flattest();
}

}  // namespace

std::vector<bool> hovering_points(const PointIndex& index, double spacing) {
  const auto& points = index.points();
  std::vector<double> own;
  std::vector<Eigen::Vector3d> dense;
  for (const auto& point : points) {
    own.push_back(own_spacing(index, point));
    if (own.back() <= kFarApart * spacing) dense.push_back(point);
  }
  std::vector<bool> hovering(points.size(), false);
  if (dense.size() < kNeighbours || dense.size() == points.size()) return hovering;
  const PointIndex skin(std::move(dense));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (own[i] <= kFarApart * spacing) continue;
    const std::size_t below = skin.nearest(points[i], 1).front().index;
    const Eigen::Vector3d arm = points[i] - skin.points()[below];
    hovering[i] = arm.norm() < kReach * own[i] &&
                  std::abs(normal_at(skin, below).dot(arm)) > kStraightAbove * arm.norm();
  }
  return hovering;
}

}  // namespace instep
