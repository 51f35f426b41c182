#include "core/girth/band/plane_slab.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/geometry/distinct_points.h"
#include "core/geometry/extent.h"
#include "core/geometry/polygon.h"

namespace instep {
namespace {

/// Places are rounded to this part, in powers of two, of what the control points are apart: to a
/// ten-thousandth of a millionth of a millimetre round a foot, and yet a thousand times what is
/// left where a cloud was turned or told in other units.
constexpr int kRoundedBits = 38;
/// Few enough to be put in order one by one, where places lie evenly.
constexpr std::size_t kPointsInAStrip = 4;

/// A place by its first coordinate, to be put in order with little to move.
struct Found {
  double x;
  std::size_t number;
};

/// Whether a place comes before another in the order of all slabs, the first of copies first.
bool comes_before(const PlaneSlab& slab, std::size_t a, std::size_t b) {
  const Eigen::Vector3d& one = slab.places[a];
  const Eigen::Vector3d& other = slab.places[b];
  return std::tuple(one.x(), one.y(), one.z(), a) < std::tuple(other.x(), other.y(), other.z(), b);
}

/// What the plane sees of a point, rounded: of points of a lattice those that are equally far stay
/// so wherever the cloud lies, and come in one order.
class RoundedView {
 public:
  explicit RoundedView(const TapePlane& plane) : plane_(plane), step_(rounding_step(plane)) {}

  Eigen::Vector3d of(const Eigen::Vector3d& point, double height) const {
    const Eigen::Vector2d place = plane_.project(point);
    const Eigen::Vector3d steps = Eigen::Vector3d(place.x(), place.y(), height) / step_;
    return steps.array().round() * step_;
  }

 private:
  const TapePlane& plane_;
  double step_;
};

/// As they come: those of `some` points of the cloud that lie as near.
PlaneSlab unordered_slab(const PointCloud& cloud, const TapePlane& plane, double half_width,
                         const std::vector<std::size_t>& some) {
  PlaneSlab slab;
  slab.indices.reserve(some.size());
  slab.places.reserve(some.size());
  const RoundedView view(plane);
  for (const std::size_t i : some) {
    const Eigen::Vector3d& point = cloud.positions[i];
    const double height = plane.distance(point);
    if (std::abs(height) > half_width) continue;
    slab.indices.push_back(i);
    slab.places.push_back(view.of(point, height));
  }
  return slab;
}

/// Sorted into strips across the first coordinate, then within each.
std::vector<Found> in_order(const PlaneSlab& slab) {
  const std::size_t count = slab.places.size();
  Extent along = Extent::none();
  for (const auto& place : slab.places) along.include(place.x());
  const std::size_t strips = 1 + count / kPointsInAStrip;
  const auto strip_of = [&](const Eigen::Vector3d& place) {
    const double part = along.to > along.from ? (place.x() - along.from) / along.length() : 0.0;
    return std::min(strips - 1, static_cast<std::size_t>(part * static_cast<double>(strips)));
  };
  std::vector<std::size_t> ends(strips + 1, 0);
  for (const auto& place : slab.places) ++ends[strip_of(place) + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Found> order(count);
  const auto begins = ends;
  for (std::size_t i = 0; i < count; ++i) {
    order[ends[strip_of(slab.places[i])]++] = {slab.places[i].x(), i};
  }
  for (std::size_t strip = 0; strip < strips; ++strip) {
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(begins[strip]),
              order.begin() + static_cast<std::ptrdiff_t>(begins[strip + 1]),
              [&](const Found& a, const Found& b) {
                return a.x != b.x ? a.x < b.x : comes_before(slab, a.number, b.number);
              });
  }
  return order;
}

/// Each place once.
PlaneSlab ordered_slab(const PointCloud& cloud, const PlaneSlab& found) {
  const std::vector<Found> order = in_order(found);
  PlaneSlab slab;
  slab.indices.reserve(order.size());
  slab.places.reserve(order.size());
  for (const auto& [x, number] : order) {
    const Eigen::Vector3d& place = found.places[number];
    if (!slab.places.empty() && slab.places.back() == place) {
      std::size_t& counting = slab.indices.back();
      if (counts_before(cloud, found.indices[number], counting)) counting = found.indices[number];
      continue;
    }
    slab.indices.push_back(found.indices[number]);
    slab.places.push_back(place);
  }
  return slab;
}

}  // namespace

double rounding_step(const TapePlane& plane) {
  const auto& [first, second, third] = plane.control_points();
  return std::ldexp(std::max((second - first).norm(), (third - first).norm()), -kRoundedBits);
}

std::vector<Eigen::Vector3d> in_steps(std::vector<Eigen::Vector3d> places, double step) {
  for (auto& place : places) place = (place / step).array().round();
  return places;
}

PlaneSlab slab_of(const PointCloud& cloud, const TapePlane& plane, double half_width) {
  return slab_of(cloud, plane, half_width, PlaneHeights(cloud, plane));
}

PlaneSlab slab_of(const PointCloud& cloud, const TapePlane& plane, double half_width,
                  const PlaneHeights& heights) {
  return ordered_slab(cloud, unordered_slab(cloud, plane, half_width, heights.about(half_width)));
}

PlaneSlab within(const PlaneSlab& slab, double half_width) {
  PlaneSlab part;
  part.indices.reserve(slab.indices.size());
  part.places.reserve(slab.places.size());
  for (std::size_t i = 0; i < slab.places.size(); ++i) {
    if (std::abs(slab.places[i].z()) > half_width) continue;
    part.indices.push_back(slab.indices[i]);
    part.places.push_back(slab.places[i]);
    if (!slab.shares.empty()) part.shares.push_back(slab.shares[i]);
    if (!slab.errors_mm.empty()) part.errors_mm.push_back(slab.errors_mm[i]);
  }
  return part;
}

PlaneSlab without(const std::vector<bool>& marked, const PlaneSlab& slab) {
  PlaneSlab rest;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (marked[i]) continue;
    rest.indices.push_back(slab.indices[i]);
    rest.places.push_back(slab.places[i]);
    if (!slab.shares.empty()) rest.shares.push_back(slab.shares[i]);
    if (!slab.errors_mm.empty()) rest.errors_mm.push_back(slab.errors_mm[i]);
  }
  return rest;
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

double tape_about(const PointCloud& cloud, const TapePlane& plane, double size) {
  return tape_round(cloud, plane, 0.01 * size);
}

bool is_round_a_crowd(double length, double tape_about) {
  return length < 0.5 * tape_about;
}

std::vector<Eigen::Vector2d> hull_of(const PlaneSlab& slab) {
  std::vector<Eigen::Vector2d> flat;
  flat.reserve(slab.places.size());
  for (const auto& place : slab.places) flat.emplace_back(place.head<2>());
  return convex_hull(std::move(flat));
}

}  // namespace instep
