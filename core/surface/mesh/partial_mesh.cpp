#include "core/surface/mesh/partial_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/geometry/plane_vectors.h"

namespace instep {
namespace {

/// What lies further above or below a triangle than this part of its longest edge is another sheet
/// of the surface.
constexpr double kSameSheet = 0.5;

/// The angle of a direction in quarters of a turn, exact at whole ones: grows with it from 0 to 4,
/// without trigonometry.
double quarters_of(const Eigen::Vector2d& direction) {
  const double sum = std::abs(direction.x()) + std::abs(direction.y());
  const double part = direction.x() / (sum > 0.0 ? sum : 1.0);
  return direction.y() >= 0.0 ? 1.0 - part : 3.0 + part;
}

/// From one to the other, counter-clockwise.
double quarters_between(double from, double to) {
  return to >= from ? to - from : to - from + 4.0;
}

/// Coordinates in a plane, and above it.
class Frame {
 public:
  Frame(const Eigen::Vector3d& origin, const Eigen::Vector3d& first, const Eigen::Vector3d& normal)
      : origin_(origin) {
    z_ = normal.normalized();
    x_ = (first - first.dot(z_) * z_).normalized();
    y_ = z_.cross(x_);
  }
  Eigen::Vector2d flat(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d offset = point - origin_;
    return {x_.dot(offset), y_.dot(offset)};
  }
  double height(const Eigen::Vector3d& point) const { return z_.dot(point - origin_); }

 private:
  Eigen::Vector3d origin_, x_, y_, z_;
};

/// Where along a segment another one crosses it, or a negative number.
double crossing(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                const Eigen::Vector2d& d) {
  const double side_c = cross(b - a, c - a);
  const double side_d = cross(b - a, d - a);
  if (side_c * side_d >= 0.0) return -1.0;
  if (cross(d - c, a - c) * cross(d - c, b - c) >= 0.0) return -1.0;
  return side_c / (side_c - side_d);
}

}  // namespace

PartialMesh::PartialMesh(const std::vector<Eigen::Vector3d>& points)
    : points_(points),
      fans_(points.size()),
      borders_(points.size()),
      normals_(points.size(), Eigen::Vector3d::Zero()) {}

bool PartialMesh::has_edge(Corner from, Corner to) const {
  return std::any_of(fans_[from].begin(), fans_[from].end(),
                     [&](const Sector& sector) { return sector.from == to; });
}

Eigen::Vector3d PartialMesh::normal_of(const Triangle& triangle) const {
  const Eigen::Vector3d& a = points_[triangle[0]];
  return (points_[triangle[1]] - a).cross(points_[triangle[2]] - a).normalized();
}

bool PartialMesh::is_clear_at(Corner corner, const Sector& sector,
                              const Eigen::Vector3d& normal) const {
  const auto& fan = fans_[corner];
  if (fan.empty()) return true;
  const Eigen::Vector3d mean = normals_[corner] + normal;
  if (!(mean.dot(normal) > 0.0)) return false;
  const Eigen::Vector3d& place = points_[corner];
  const Frame frame(place, points_[sector.from] - place, mean);
  const double width = quarters_of(frame.flat(points_[sector.to]));
  if (!(width < 2.0)) return false;
  return std::none_of(fan.begin(), fan.end(), [&](const Sector& other) {
    const double from = quarters_of(frame.flat(points_[other.from]));
    const double to = quarters_of(frame.flat(points_[other.to]));
    const bool starts_inside = other.from != sector.to && from < width;
    const bool holds_start =
        other.to != sector.from && quarters_between(from, 4.0) < quarters_between(from, to);
    return starts_inside || holds_start;
  });
}

std::vector<PartialMesh::Corner> PartialMesh::border_of(const std::vector<Sector>& fan) {
  std::vector<Corner> ends;
  for (const Sector& sector : fan) {
    const auto goes_on = [&](Corner Sector::*side, Corner end) {
      return std::any_of(fan.begin(), fan.end(),
                         [&](const Sector& other) { return other.*side == end; });
    };
    if (!goes_on(&Sector::to, sector.from)) ends.push_back(sector.from);
    if (!goes_on(&Sector::from, sector.to)) ends.push_back(sector.to);
  }
  return ends;
}

bool PartialMesh::is_clear_of_others(const Triangle& triangle, const Eigen::Vector3d& normal,
                                     const std::vector<Corner>& nearby) const {
  std::array<Eigen::Vector2d, 3> flat;
  double longest = 0.0;
  const Frame frame(points_[triangle[0]], points_[triangle[1]] - points_[triangle[0]], normal);
  for (std::size_t k = 0; k < 3; ++k) {
    flat[k] = frame.flat(points_[triangle[k]]);
    longest = std::max(longest, (points_[triangle[k]] - points_[triangle[(k + 1) % 3]]).norm());
  }
  const auto is_own = [&](Corner corner) {
    return std::find(triangle.begin(), triangle.end(), corner) != triangle.end();
  };
  const auto holds = [&](const Eigen::Vector2d& place) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (cross(flat[(k + 1) % 3] - flat[k], place - flat[k]) <= 0.0) return false;
    }
    return true;
  };
  for (const Corner corner : nearby) {
    if (!has_corner(corner) || is_own(corner)) continue;
    const Eigen::Vector2d place = frame.flat(points_[corner]);
    const double height = frame.height(points_[corner]);
    if (std::abs(height) < kSameSheet * longest && holds(place)) return false;
    for (const Corner end : borders_[corner]) {
      const Eigen::Vector2d end_place = frame.flat(points_[end]);
      const double end_height = frame.height(points_[end]);
      for (std::size_t k = 0; k < 3; ++k) {
        if (end == triangle[k] || end == triangle[(k + 1) % 3]) continue;
        const double part = crossing(flat[k], flat[(k + 1) % 3], place, end_place);
        if (part < 0.0) continue;
        if (std::abs(height + part * (end_height - height)) < kSameSheet * longest) return false;
      }
    }
  }
  return true;
}

bool PartialMesh::is_hole(const Triangle& triangle) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner from = triangle[k];
    const Corner to = triangle[(k + 1) % 3];
    if (has_edge(from, to) || !has_edge(to, from)) return false;
  }
  return true;
}

bool PartialMesh::accepts(const Triangle& triangle, const std::vector<Corner>& nearby) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_surrounded(triangle[k]) || has_edge(triangle[k], triangle[(k + 1) % 3])) return false;
  }
  const Eigen::Vector3d normal = normal_of(triangle);
  for (std::size_t k = 0; k < 3; ++k) {
    const Sector sector{triangle[(k + 1) % 3], triangle[(k + 2) % 3]};
    if (!is_clear_at(triangle[k], sector, normal)) return false;
  }
  return is_clear_of_others(triangle, normal, nearby);
}

void PartialMesh::add(const Triangle& triangle) {
  const Eigen::Vector3d normal = normal_of(triangle);
  triangles_.push_back(triangle);
  for (std::size_t k = 0; k < 3; ++k) {
    fans_[triangle[k]].push_back({triangle[(k + 1) % 3], triangle[(k + 2) % 3]});
    normals_[triangle[k]] += normal;
  }
  for (const Corner corner : triangle) borders_[corner] = border_of(fans_[corner]);
}

}  // namespace instep
