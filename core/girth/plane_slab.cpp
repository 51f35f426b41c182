#include "core/girth/plane_slab.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

/// A place of the cloud with its distance from the plane, to be put in order by the place alone.
struct Found {
  Eigen::Vector3d place;
  std::size_t index;

  bool operator<(const Found& other) const {
    if (place.x() != other.place.x()) return place.x() < other.place.x();
    return std::tuple(place.y(), place.z(), index) <
           std::tuple(other.place.y(), other.place.z(), other.index);
  }
};

}  // namespace

PlaneSlab slab_of(const PointCloud& cloud, const TapePlane& plane, double half_width) {
  std::vector<Found> found;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double height = plane.distance(cloud.positions[i]);
    if (std::abs(height) > half_width) continue;
    const Eigen::Vector2d place = plane.project(cloud.positions[i]);
    found.push_back({{place.x(), place.y(), height}, i});
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end(),
                          [](const Found& a, const Found& b) { return a.place == b.place; }),
              found.end());
  PlaneSlab slab;
  slab.indices.reserve(found.size());
  slab.places.reserve(found.size());
  for (const auto& [place, index] : found) {
    slab.indices.push_back(index);
    slab.places.push_back(place);
  }
  return slab;
}

bool is_cut(const std::vector<Eigen::Vector3d>& places) {
  constexpr std::size_t kOneOf = 50;
  std::size_t above = 0;
  std::size_t below = 0;
  for (const auto& place : places) {
    if (place.z() >= 0.0) ++above;
    if (place.z() <= 0.0) ++below;
  }
  return std::min(above, below) * kOneOf >= places.size();
}

double tape_round(const PointCloud& cloud, const TapePlane& plane, double half_width) {
  constexpr int kDirections = 16;
  Eigen::Matrix<double, kDirections, 2> directions;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = std::numbers::pi * i / kDirections;
    directions.row(i) << std::cos(angle), std::sin(angle);
  }
  using Reaches = Eigen::Array<double, kDirections, 1>;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Reaches least = Reaches::Constant(kInfinity);
  Reaches most = Reaches::Constant(-kInfinity);
  for (const auto& position : cloud.positions) {
    if (std::abs(plane.distance(position)) > half_width) continue;
    const Reaches reaches = (directions * plane.project(position)).array();
    least = least.min(reaches);
    most = most.max(reaches);
  }
  return least[0] < kInfinity ? std::numbers::pi * (most - least).mean() : 0.0;
}

std::vector<Eigen::Vector2d> hull_of(const PlaneSlab& slab) {
  std::vector<Eigen::Vector2d> flat;
  flat.reserve(slab.places.size());
  for (const auto& place : slab.places) flat.emplace_back(place.head<2>());
  return convex_hull(std::move(flat));
}

}  // namespace instep
