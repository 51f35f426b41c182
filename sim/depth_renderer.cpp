#include "sim/depth_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kNowhere = std::numeric_limits<double>::infinity();
/// Share of a solid's value by which a ray advances: values may exceed the distance by up to 1.4
/// where two skins meet in a rounded edge.
constexpr double kStride = 0.7;
constexpr int kTile = 8;

struct Hit {
  double distance = kNowhere;  ///< along the ray
  double incidence = 0.0;
  double depth = 0.0;  ///< along the optical axis
};

/// A ray in a solid's own frame; `direction` has unit length.
struct Ray {
  Vector3d origin;
  Vector3d direction;
  Vector3d at(double distance) const { return origin + distance * direction; }
};

Ray ray_in_frame(const RigidTransform& frame_from_station, const Ray& ray) {
  return {frame_from_station * ray.origin, frame_from_station.linear() * ray.direction};
}

double incidence_at(const Vector3d& direction, const Vector3d& normal) {
  return std::acos(std::clamp(-direction.dot(normal), 0.0, 1.0));
}

struct Span {
  double enter = 0.0;
  double leave = -1.0;
  int axis = 0;  ///< of the face by which the ray enters
  bool hit() const { return enter <= leave; }
};

Span span_in_box(const Ray& ray, const Eigen::AlignedBox3d& box) {
  Span span{0.0, kNowhere, -1};
  for (int axis = 0; axis < 3; ++axis) {
    const double slope = ray.direction[axis];
    if (slope == 0.0) {
      const double at = ray.origin[axis];
      if (at < box.min()[axis] || at > box.max()[axis]) return {};
      continue;
    }
    double near = (box.min()[axis] - ray.origin[axis]) / slope;
    double far = (box.max()[axis] - ray.origin[axis]) / slope;
    if (near > far) std::swap(near, far);
    if (near > span.enter) span = {near, span.leave, axis};
    span.leave = std::min(span.leave, far);
  }
  return span;
}

Hit hit_platform(const Ray& ray, const Platform& platform) {
  const Vector3d half(0.5 * platform.length_mm, 0.5 * platform.width_mm, 0.0);
  const Vector3d depth(0.0, 0.0, platform.thickness_mm);
  const Span span = span_in_box(ray, {-half - depth, half});
  if (!span.hit() || span.axis < 0) return {};
  Vector3d normal = Vector3d::Zero();
  normal[span.axis] = ray.direction[span.axis] > 0 ? -1.0 : 1.0;
  return {span.enter, incidence_at(ray.direction, normal)};
}

/// Walks along the ray from `start` to the skin; kNowhere if it leaves at `end` before.
double walk_to_skin(const Solid& solid, const Ray& ray, double start, double end) {
  constexpr double kPrecisionMm = 1e-4;
  constexpr double kNearMm = 2.0;
  constexpr int kMostSteps = 400;
  double at = start;
  double value = solid.value(ray.at(at));
  double slope = -1.0;
  for (int step = 0; step < kMostSteps && at <= end; ++step) {
    if (std::abs(value) < kPrecisionMm) return at;
    double advance = kStride * value;
    if (std::abs(value) < kNearMm && slope < -0.05) {
      advance = std::clamp(-value / slope, -4.0 * std::abs(value), 4.0 * std::abs(value));
    }
    const double next = solid.value(ray.at(at + advance));
    slope = (next - value) / advance;
    at += advance;
    value = next;
  }
  return std::abs(value) < kPrecisionMm ? at : kNowhere;
}

/// How far the whole cone of rays within `spread` (tangent of its half angle) of `ray` may go
/// without touching the solid.
double walk_of_cone(const Solid& solid, const Ray& ray, double spread, double end) {
  constexpr double kWorthwhileMm = 1.0;
  double at = 0.0;
  while (at <= end) {
    const double free = kStride * solid.value(ray.at(at)) - at * spread;
    if (free < kWorthwhileMm) return at;
    at += free / (1.0 + spread);
  }
  return at;
}

/// The lines of sight of a camera, as unit vectors in the station frame; zero where there is none.
std::vector<Vector3d> sight_lines(const CameraGeometry& camera) {
  const CameraIntrinsics& lens = camera.intrinsics;
  std::vector<Vector3d> lines;
  lines.reserve(static_cast<std::size_t>(lens.width) * static_cast<std::size_t>(lens.height));
  for (int v = 0; v < lens.height; ++v) {
    for (int u = 0; u < lens.width; ++u) {
      Vector3d line = Vector3d::Zero();
      if (line_of_sight(lens, u, v, line)) {
        line = camera.station_from_camera.linear() * line.normalized();
      }
      lines.push_back(line);
    }
  }
  return lines;
}

class Renderer {
 public:
  Renderer(const Scene& scene, const CameraGeometry& camera)
      : scene_(scene),
        width_(camera.intrinsics.width),
        height_(camera.intrinsics.height),
        eye_(camera.station_from_camera.translation()),
        forward_(camera.station_from_camera.linear().col(2)),
        lines_(sight_lines(camera)),
        hits_(lines_.size()) {}

  std::vector<Hit> run() {
    if (scene_.platform) {
      for (std::size_t i = 0; i < lines_.size(); ++i) {
        if (!lines_[i].isZero()) hits_[i] = hit_platform({eye_, lines_[i]}, *scene_.platform);
      }
    }
    for (const PlacedSolid& placed : scene_.solids) {
      for (int v = 0; v < height_; v += kTile) {
        for (int u = 0; u < width_; u += kTile) look_at_tile(placed, u, v);
      }
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      hits_[i].depth = hits_[i].distance * forward_.dot(lines_[i]);
    }
    return std::move(hits_);
  }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  }

  void look_at_tile(const PlacedSolid& placed, int left, int top) {
    const int right = std::min(left + kTile, width_);
    const int bottom = std::min(top + kTile, height_);
    const Vector3d centre = lines_[index((left + right) / 2, (top + bottom) / 2)];
    if (centre.isZero()) return look_at_pixels(placed, left, right, top, bottom, 0.0);
    double narrowest = 1.0;
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) {
        const double cosine = centre.dot(lines_[index(u, v)]);
        if (cosine > 0.0) narrowest = std::min(narrowest, cosine);
      }
    }
    const double spread = std::sqrt(std::max(0.0, 1.0 / (narrowest * narrowest) - 1.0));
    const Ray ray = ray_in_frame(placed.station_from_solid.inverse(), {eye_, centre});
    const double end = furthest(*placed.solid, ray.origin);
    const double start = walk_of_cone(*placed.solid, ray, spread, end);
    if (start <= end) look_at_pixels(placed, left, right, top, bottom, start * narrowest);
  }

  void look_at_pixels(const PlacedSolid& placed, int left, int right, int top, int bottom,
                      double start) {
    const RigidTransform solid_from_station = placed.station_from_solid.inverse();
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) {
        const std::size_t pixel = index(u, v);
        if (lines_[pixel].isZero()) continue;
        const Ray ray = ray_in_frame(solid_from_station, {eye_, lines_[pixel]});
        const Span span = span_in_box(ray, placed.solid->bounds());
        const double from = std::max(start, span.enter - 1.0);
        if (!span.hit() || from > hits_[pixel].distance) continue;
        const double distance = walk_to_skin(*placed.solid, ray, from, span.leave + 1.0);
        if (distance >= hits_[pixel].distance) continue;
        const Vector3d normal = placed.solid->normal(ray.at(distance));
        hits_[pixel] = {distance, incidence_at(ray.direction, normal)};
      }
    }
  }

  static double furthest(const Solid& solid, const Vector3d& origin) {
    const Eigen::AlignedBox3d box = solid.bounds();
    return (box.center() - origin).norm() + 0.5 * box.diagonal().norm();
  }

  const Scene& scene_;
  int width_;
  int height_;
  Vector3d eye_;
  Vector3d forward_;
  std::vector<Vector3d> lines_;
  std::vector<Hit> hits_;
};

void mark_edges(ExactView& view) {
  const auto index = [&](int u, int v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(view.width) +
           static_cast<std::size_t>(u);
  };
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const float here = view.depth_mm[index(u, v)];
      bool edge = false;
      for (int dv = -1; dv <= 1 && here > 0; ++dv) {
        for (int du = -1; du <= 1; ++du) {
          const int un = u + du, vn = v + dv;
          if (un < 0 || vn < 0 || un >= view.width || vn >= view.height) continue;
          const float there = view.depth_mm[index(un, vn)];
          edge = edge || std::abs(there - here) > static_cast<float>(kDepthJumpMm);
        }
      }
      view.edge[index(u, v)] = edge ? 1 : 0;
    }
  }
}

}  // namespace

bool line_of_sight(const CameraIntrinsics& lens, double u, double v, Vector3d& direction) {
  const double xd = (u - lens.cx) / lens.fx;
  const double yd = (v - lens.cy) / lens.fy;
  const auto& [k1, k2, p1, p2, k3] = lens.distortion;
  double x = xd, y = yd;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double bend_x = 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x);
    const double bend_y = p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
    const double next_x = (xd - bend_x) / radial;
    const double next_y = (yd - bend_y) / radial;
    const double moved = std::hypot(next_x - x, next_y - y);
    x = next_x;
    y = next_y;
    if (!(moved < 10.0)) return false;
    if (moved < 1e-12) {
      direction = {x, y, 1.0};
      return true;
    }
  }
  return false;
}

ExactView render_depth(const Scene& scene, const CameraGeometry& camera) {
  const std::vector<Hit> hits = Renderer(scene, camera).run();
  ExactView view{camera.intrinsics.width, camera.intrinsics.height, {}, {}, {}};
  view.depth_mm.assign(hits.size(), 0.0F);
  view.incidence_rad.assign(hits.size(), 0.0F);
  view.edge.assign(hits.size(), 0);
  for (std::size_t pixel = 0; pixel < hits.size(); ++pixel) {
    if (hits[pixel].distance == kNowhere) continue;
    view.depth_mm[pixel] = static_cast<float>(hits[pixel].depth);
    view.incidence_rad[pixel] = static_cast<float>(hits[pixel].incidence);
  }
  mark_edges(view);
  return view;
}

}  // namespace instep
