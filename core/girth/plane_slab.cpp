#include "core/girth/plane_slab.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "core/geometry/distinct_points.h"
#include "core/geometry/polygon.h"
#include "core/girth/thinned_lines.h"

namespace instep {
namespace {

/// The first slab that is asked for is to tell how wide the others have to be.
constexpr double kWiderThanFirst = 6.0;
constexpr double kWiderThanOthers = 1.2;
/// How far from the plane points are near it, against the size of the cloud by a sample of so many:
/// the first slab is as wide (section_probe.cpp). What rounding may bring in or leave out lies
/// beyond this part of that.
constexpr double kNear = 0.026;
constexpr std::size_t kSample = 2000;
constexpr double kSurelyNear = 0.999;
/// As many as a number has bits.
constexpr std::size_t kPairsAtOnce = 64;
/// Few enough to be put in order one by one, where places lie evenly.
constexpr std::size_t kPointsInAStrip = 4;

/// Two points at a time, which costs no more than one.
struct PointPair {
  Eigen::Array2d x;
  Eigen::Array2d y;
  Eigen::Array2d z;

  PointPair(const Eigen::Vector3d& one, const Eigen::Vector3d& other)
      : x(one.x(), other.x()), y(one.y(), other.y()), z(one.z(), other.z()) {}

  Eigen::Array2d along(const Eigen::Vector3d& direction) const {
    return direction.x() * x + direction.y() * y + direction.z() * z;
  }
};

/// From the least to the most of what a cloud measures along a direction.
class Reach {
 public:
  void add(const Eigen::Array2d& measures) {
    least_ = measures.min(least_);
    most_ = measures.max(most_);
  }
  double length() const { return most_.maxCoeff() - least_.minCoeff(); }

 private:
  Eigen::Array2d least_ = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d most_ = Eigen::Array2d::Constant(-std::numeric_limits<double>::infinity());
};

/// The box of a cloud as the plane sees it.
class PlaneBox {
 public:
  explicit PlaneBox(const TapePlane& plane)
      : u_(plane.u()),
        v_(plane.v()),
        normal_(plane.normal()),
        level_(plane.normal().dot(plane.origin())) {}

  /// Returns how far above the plane the two points are.
  Eigen::Array2d add(const PointPair& pair) {
    along_.add(pair.along(u_));
    across_.add(pair.along(v_));
    const Eigen::Array2d heights = pair.along(normal_);
    above_.add(heights);
    return heights - level_;
  }

  /// Each two points that follow each other, up to kPairsAtOnce, of an odd number all but the last.
  /// Returns a bit for each pair, the lowest for the first: whether one of the two is at most
  /// `half_width` from the plane.
  std::uint64_t add_pairs(std::span<const Eigen::Vector3d> points, double half_width) {
    std::uint64_t near = 0;
    PlaneBox wider = *this;  // A member would be written back at each step.
    for (std::size_t i = points.size() / 2; i-- > 0;) {
      const Eigen::Array2d heights = wider.add({points[2 * i], points[2 * i + 1]});
      near = 2 * near + (heights.abs().minCoeff() <= half_width ? 1U : 0U);
    }
    *this = wider;
    return near;
  }

  double diagonal() const { return std::hypot(along_.length(), across_.length(), above_.length()); }

 private:
  Eigen::Vector3d u_;
  Eigen::Vector3d v_;
  Eigen::Vector3d normal_;
  double level_;
  Reach along_;
  Reach across_;
  Reach above_;
};

/// The size of a cloud by a sample of its points: a little less than it is.
double rough_size(std::span<const Eigen::Vector3d> points, const TapePlane& plane) {
  const std::size_t stride = points.size() / kSample + 1;
  PlaneBox box(plane);
  for (std::size_t i = 0; i < points.size(); i += stride) box.add({points[i], points[i]});
  return box.diagonal();
}

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

void add_if_near(const PointCloud& cloud, const TapePlane& plane, double half_width, std::size_t i,
                 PlaneSlab& slab) {
  const Eigen::Vector3d& point = cloud.positions[i];
  const double height = plane.distance(point);
  if (std::abs(height) > half_width) return;
  const Eigen::Vector2d place = plane.project(point);
  slab.indices.push_back(i);
  slab.places.emplace_back(place.x(), place.y(), height);
}

/// Sorted into strips across the first coordinate, then within each.
std::vector<Found> in_order(const PlaneSlab& slab) {
  const std::size_t count = slab.places.size();
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const auto& place : slab.places) {
    least = std::min(least, place.x());
    most = std::max(most, place.x());
  }
  const std::size_t strips = 1 + count / kPointsInAStrip;
  const auto strip_of = [&](const Eigen::Vector3d& place) {
    const double part = most > least ? (place.x() - least) / (most - least) : 0.0;
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

PlaneSlab slab_of(const PointCloud& cloud, const TapePlane& plane, double half_width) {
  PlaneSlab found;
  for (std::size_t i = 0; i < cloud.size(); ++i) add_if_near(cloud, plane, half_width, i, found);
  return ordered_slab(cloud, found);
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
  }
  return rest;
}

/// Looks at each point once: at the box of all, and which lie near the plane.
SlabSource::SlabSource(const PointCloud& cloud, const TapePlane& plane)
    : cloud_(cloud), plane_(plane) {
  const std::span<const Eigen::Vector3d> points(cloud.positions);
  near_half_width_ = kNear * rough_size(points, plane);
  PlaneBox box(plane);
  for (std::size_t begin = 0; begin < points.size(); begin += 2 * kPairsAtOnce) {
    const std::size_t count = std::min(2 * kPairsAtOnce, points.size() - begin);
    std::uint64_t near = box.add_pairs(points.subspan(begin, count), near_half_width_);
    for (; near != 0; near &= near - 1) {
      near_pairs_.push_back(begin + 2 * static_cast<std::size_t>(std::countr_zero(near)));
    }
  }
  if (points.size() % 2 != 0) {
    box.add({points.back(), points.back()});
    near_pairs_.push_back(points.size() - 1);
  }
  size_ = box.diagonal();
}

PlaneSlab SlabSource::whole_slab(double half_width) const {
  if (half_width > kSurelyNear * near_half_width_) return slab_of(cloud_, plane_, half_width);
  PlaneSlab found;
  for (const std::size_t i : near_pairs_) {
    add_if_near(cloud_, plane_, half_width, i, found);
    if (i + 1 < cloud_.size()) add_if_near(cloud_, plane_, half_width, i + 1, found);
  }
  return ordered_slab(cloud_, found);
}

PlaneSlab SlabSource::slab(double half_width) {
  if (half_width > half_width_) {
    half_width_ = (half_width_ < 0.0 ? kWiderThanFirst : kWiderThanOthers) * half_width;
    widest_ = whole_slab(half_width_);
    if (lines_) widest_ = thinned_lines(cloud_, widest_, *lines_);
  }
  return within(widest_, half_width);
}

void SlabSource::thin(const ScanLines& lines) {
  lines_ = lines;
  widest_ = thinned_lines(cloud_, widest_, lines);
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
