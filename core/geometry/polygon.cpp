#include "core/geometry/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/geometry/plane_vectors.h"

namespace instep {
namespace {

bool left_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

/// In order, whatever they were; quicker where they come in few long runs to and fro, as those
/// along a line do.
void sort_from_the_left(std::vector<Eigen::Vector2d>& points) {
  constexpr std::size_t kMostRuns = 16;
  std::vector<std::vector<Eigen::Vector2d>::iterator> ends = {points.begin()};
  while (ends.back() != points.end() && ends.size() <= kMostRuns) {
    const auto begin = ends.back();
    const auto falls = [](const auto& a, const auto& b) { return left_of(b, a); };
    auto end = std::is_sorted_until(begin, points.end(), left_of);
    const auto other = std::is_sorted_until(begin, points.end(), falls);
    if (other > end) {
      end = other;
      std::reverse(begin, end);
    }
    ends.push_back(end);
  }
  if (ends.back() != points.end()) return std::sort(points.begin(), points.end(), left_of);
  for (; ends.size() > 2; ends.pop_back()) {
    std::inplace_merge(ends[ends.size() - 3], ends[ends.size() - 2], ends.back(), left_of);
    ends[ends.size() - 2] = ends.back();
  }
}

/// Appends the chain that keeps turning left over points in the order given.
template <typename Iterator>
void append_chain(Iterator begin, Iterator end, std::vector<Eigen::Vector2d>& hull) {
  const std::size_t start = hull.size();
  for (Iterator it = begin; it != end; ++it) {
    while (hull.size() >= start + 2 &&
           cross(hull.back() - hull[hull.size() - 2], *it - hull.back()) <= 0.0) {
      hull.pop_back();
    }
    hull.push_back(*it);
  }
  hull.pop_back();  // the next chain begins with it
}

/// Drops points well inside the furthest ones in eight directions: they are on no hull, and most
/// points of a crowd are such (Akl, Toussaint: A fast convex hull algorithm, 1978).
void drop_inner(std::vector<Eigen::Vector2d>& points) {
  constexpr std::size_t kWorthwhile = 64;
  if (points.size() < kWorthwhile) return;
  const std::array<Eigen::Vector2d, 8> directions{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  std::array<Eigen::Vector2d, 8> corners;
  std::array<double, 8> furthest;
  furthest.fill(-std::numeric_limits<double>::infinity());
  for (const auto& point : points) {
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double far = directions[i].dot(point);
      if (!(far > furthest[i])) continue;
      furthest[i] = far;
      corners[i] = point;
    }
  }
  std::erase_if(points, [&](const Eigen::Vector2d& point) {
    bool is_inner = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d edge = corners[(i + 1) % corners.size()] - corners[i];
      if (edge.isZero(0.0)) continue;  // one corner is furthest in two directions
      is_inner = cross(edge, point - corners[i]) > 0.0;
      if (!is_inner) return false;
    }
    return is_inner;
  });
}

}  // namespace

std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  drop_inner(points);
  sort_from_the_left(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  append_chain(points.begin(), points.end(), hull);
  append_chain(points.rbegin(), points.rend(), hull);
  return hull;
}

double perimeter(const std::vector<Eigen::Vector2d>& polygon) {
  double length = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    length += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  }
  return length;
}

double signed_area(const std::vector<Eigen::Vector2d>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return 0.5 * twice;
}

bool is_ring(const std::vector<Eigen::Vector2d>& polygon) {
  constexpr double kFlattest = 1e-6;
  const double length = perimeter(polygon);
  return polygon.size() >= 3 && std::abs(signed_area(polygon)) > kFlattest * length * length;
}

double depth_in(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d along = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
    least = std::min(least, cross(along, point - polygon[i]));
  }
  return least;
}

BorderPlace nearest_on_border(const std::vector<Eigen::Vector2d>& polygon,
                              const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  double nearest_way = 0.0;
  double way = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = edge.norm();
    const Eigen::Vector2d along = edge / (length > 0.0 ? length : 1.0);
    const double part = std::clamp(along.dot(point - polygon[i]), 0.0, length);
    const double squared = (polygon[i] + part * along - point).squaredNorm();
    if (squared < nearest) {
      nearest = squared;
      nearest_way = way + part;
    }
    way += length;
  }
  return {nearest_way, std::sqrt(nearest)};
}

std::vector<Eigen::Vector2d> clipped(const std::vector<Eigen::Vector2d>& polygon,
                                     const Eigen::Vector2d& inward, double level) {
  std::vector<Eigen::Vector2d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& from = polygon[i];
    const Eigen::Vector2d& to = polygon[(i + 1) % polygon.size()];
    const double from_height = inward.dot(from) - level;
    const double to_height = inward.dot(to) - level;
    if (from_height >= 0.0) kept.push_back(from);
    if ((from_height >= 0.0) != (to_height >= 0.0)) {
      kept.push_back(from + (to - from) * (from_height / (from_height - to_height)));
    }
  }
  return kept;
}

}  // namespace instep
