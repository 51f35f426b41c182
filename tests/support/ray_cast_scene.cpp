#include "tests/support/ray_cast_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class Disc : public AnalyticSurface {
 public:
  Disc(const Vector3d& point, const Vector3d& normal, double radius)
      : point_(point), normal_(normal.normalized()), radius_(radius) {}
  std::optional<double> hit(const Vector3d& origin, const Vector3d& direction) const override {
    const double t = normal_.dot(point_ - origin) / normal_.dot(direction);
    if (!(t > 0.0) || (origin + t * direction - point_).norm() > radius_) return std::nullopt;
    return t;
  }
  double distance(const Vector3d& point) const override { return normal_.dot(point - point_); }
  Vector3d normal(const Vector3d&) const override { return normal_; }

 private:
  Vector3d point_;
  Vector3d normal_;
  double radius_;
};

std::optional<double> smallest_positive_root(double a, double half_b, double c) {
  const double discriminant = half_b * half_b - a * c;
  if (discriminant < 0.0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  const double near = (-half_b - root) / a;
  const double far = (-half_b + root) / a;
  if (near > 0.0) return near;
  if (far > 0.0) return far;
  return std::nullopt;
}

class Ellipsoid : public AnalyticSurface {
 public:
  Ellipsoid(const Vector3d& centre, const Vector3d& semi_axes, double degrees)
      : centre_(centre), semi_axes_(semi_axes) {
    own_from_world_ = Eigen::AngleAxisd(-degrees * std::numbers::pi / 180.0, Vector3d::UnitZ())
                          .toRotationMatrix();
  }
  std::optional<double> hit(const Vector3d& origin, const Vector3d& direction) const override {
    const Vector3d o = (own_from_world_ * (origin - centre_)).cwiseQuotient(semi_axes_);
    const Vector3d d = (own_from_world_ * direction).cwiseQuotient(semi_axes_);
    return smallest_positive_root(d.squaredNorm(), o.dot(d), o.squaredNorm() - 1.0);
  }
  double distance(const Vector3d& point) const override {
    const Vector3d own = own_from_world_ * (point - centre_);
    const double level = own.cwiseQuotient(semi_axes_).norm();
    const Vector3d slope = own.cwiseQuotient(semi_axes_.cwiseProduct(semi_axes_)) / level;
    return (level - 1.0) / slope.norm();
  }
  Vector3d normal(const Vector3d& point) const override {
    const Vector3d own = own_from_world_ * (point - centre_);
    return own_from_world_.transpose() *
           own.cwiseQuotient(semi_axes_.cwiseProduct(semi_axes_)).normalized();
  }

 private:
  Vector3d centre_;
  Vector3d semi_axes_;
  Eigen::Matrix3d own_from_world_;
};

class Cylinder : public AnalyticSurface {
 public:
  Cylinder(const Vector2d& centre, double radius, double bottom, double top)
      : centre_(centre), radius_(radius), bottom_(bottom), top_(top) {}
  std::optional<double> hit(const Vector3d& origin, const Vector3d& direction) const override {
    const Vector2d o = origin.head<2>() - centre_;
    const Vector2d d = direction.head<2>();
    const double half_b = o.dot(d);
    const double c = o.squaredNorm() - radius_ * radius_;
    const double root = std::sqrt(std::max(0.0, half_b * half_b - d.squaredNorm() * c));
    if (half_b * half_b < d.squaredNorm() * c) return std::nullopt;
    for (const double t :
         {(-half_b - root) / d.squaredNorm(), (-half_b + root) / d.squaredNorm()}) {
      const double z = origin.z() + t * direction.z();
      if (t > 0.0 && z >= bottom_ && z <= top_) return t;
    }
    return std::nullopt;
  }
  double distance(const Vector3d& point) const override {
    return (point.head<2>() - centre_).norm() - radius_;
  }
  Vector3d normal(const Vector3d& point) const override {
    const Vector2d out = (point.head<2>() - centre_).normalized();
    return {out.x(), out.y(), 0.0};
  }

 private:
  Vector2d centre_;
  double radius_;
  double bottom_;
  double top_;
};

/// Met by sphere tracing of its exact distance.
class Puck : public AnalyticSurface {
 public:
  Puck(const Vector2d& centre, double radius, double height, double rounding)
      : centre_(centre), radius_(radius), height_(height), rounding_(rounding) {}
  std::optional<double> hit(const Vector3d& origin, const Vector3d& direction) const override {
    const double scale = direction.norm();
    double t = 0.0;
    for (int i = 0; i < 300; ++i) {
      const double step = distance(origin + t * direction);
      if (step < 1e-7) return t;
      t += step / scale;
      if (t * scale > 5000.0) return std::nullopt;
    }
    return std::nullopt;
  }
  double distance(const Vector3d& point) const override {
    // In the half plane through the axis: a box whose lower corner is an arc.
    const double out = (point.head<2>() - centre_).norm() - radius_;
    const double above = point.z() - height_;
    if (point.z() < rounding_ && out > -rounding_) {
      return Vector2d(out + rounding_, point.z() - rounding_).norm() - rounding_;
    }
    const double side = out;
    const double face = std::max(above, -point.z());
    if (side > 0.0 && face > 0.0) return Vector2d(side, face).norm();
    return std::max(side, face);
  }
  Vector3d normal(const Vector3d& point) const override {
    Vector3d slope;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d step = 1e-5 * Vector3d::Unit(axis);
      slope[axis] = distance(point + step) - distance(point - step);
    }
    return slope.normalized();
  }

 private:
  Vector2d centre_;
  double radius_;
  double height_;
  double rounding_;
};

/// The ideal ray of a pixel by plain fixed-point iteration on the lens formula.
Vector3d pixel_ray(const CameraIntrinsics& lens, int u, int v) {
  const auto& [k1, k2, p1, p2, k3] = lens.distortion;
  const Vector2d target((u - lens.cx) / lens.fx, (v - lens.cy) / lens.fy);
  Vector2d ideal = target;
  for (int i = 0; i < 100; ++i) {
    const double r2 = ideal.squaredNorm();
    const double radial = 1 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2;
    const double xy = ideal.x() * ideal.y();
    const Vector2d tangential(2 * p1 * xy + p2 * (r2 + 2 * ideal.x() * ideal.x()),
                              p1 * (r2 + 2 * ideal.y() * ideal.y()) + 2 * p2 * xy);
    const Vector2d next = (target - tangential) / radial;
    if (next == ideal) break;
    ideal = next;
  }
  return {ideal.x(), ideal.y(), 1.0};
}

std::vector<double> exact_depths(const CameraGeometry& camera, const Surfaces& surfaces) {
  const auto& lens = camera.intrinsics;
  std::vector<double> depths;
  for (int v = 0; v < lens.height; ++v) {
    for (int u = 0; u < lens.width; ++u) {
      const Vector3d direction = camera.station_from_camera.linear() * pixel_ray(lens, u, v);
      double nearest = 0.0;
      for (const auto& surface : surfaces) {
        const auto t = surface->hit(camera.station_from_camera.translation(), direction);
        if (t && (nearest == 0.0 || *t < nearest)) nearest = *t;
      }
      depths.push_back(nearest);
    }
  }
  return depths;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace

std::shared_ptr<const AnalyticSurface> disc_surface(const Vector3d& point, const Vector3d& normal,
                                                    double radius) {
  return std::make_shared<Disc>(point, normal, radius);
}

std::shared_ptr<const AnalyticSurface> ellipsoid_surface(const Vector3d& centre,
                                                         const Vector3d& semi_axes,
                                                         double degrees) {
  return std::make_shared<Ellipsoid>(centre, semi_axes, degrees);
}

std::shared_ptr<const AnalyticSurface> cylinder_surface(const Vector2d& centre, double radius,
                                                        double bottom, double top) {
  return std::make_shared<Cylinder>(centre, radius, bottom, top);
}

std::shared_ptr<const AnalyticSurface> rounded_puck(const Vector2d& centre, double radius,
                                                    double height, double rounding) {
  return std::make_shared<Puck>(centre, radius, height, rounding);
}

CameraGeometry camera_looking_at(const std::string& id, const Vector3d& eye, const Vector3d& target,
                                 int width, int height, double focal) {
  CameraGeometry camera;
  camera.id = id;
  camera.intrinsics.width = width;
  camera.intrinsics.height = height;
  camera.intrinsics.fx = camera.intrinsics.fy = focal;
  camera.intrinsics.cx = 0.5 * (width - 1);
  camera.intrinsics.cy = 0.5 * (height - 1);
  const Vector3d forward = (target - eye).normalized();
  const Vector3d up = std::abs(forward.z()) > 0.99 ? Vector3d::UnitY() : Vector3d::UnitZ();
  const Vector3d right = forward.cross(up).normalized();
  camera.station_from_camera.linear() << right, forward.cross(right), forward;
  camera.station_from_camera.translation() = eye;
  return camera;
}

std::vector<CameraGeometry> ring_of_cameras(int count, double radius, double height,
                                            const Vector3d& target) {
  std::vector<CameraGeometry> cameras;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / count;
    const Vector3d eye(radius * std::cos(angle), radius * std::sin(angle), height);
    cameras.push_back(camera_looking_at("camera" + std::to_string(i), eye, target));
  }
  return cameras;
}

DepthFrame render(const CameraGeometry& camera, const Surfaces& surfaces, const RenderNoise& noise,
                  std::uint64_t seed, double unit_mm) {
  const auto depths = exact_depths(camera, surfaces);
  const int width = camera.intrinsics.width;
  DepthFrame frame;
  frame.camera = camera.id;
  frame.width = width;
  frame.height = camera.intrinsics.height;
  frame.depth_unit_mm = unit_mm;
  Random random(seed);
  for (std::size_t pixel = 0; pixel < depths.size(); ++pixel) {
    double depth = depths[pixel];
    const std::size_t next = pixel + 1 < depths.size() ? pixel + 1 : pixel;
    const std::size_t below = std::min(depths.size() - 1, pixel + static_cast<std::size_t>(width));
    for (const std::size_t other : {next, below}) {
      const bool edge =
          depth > 0.0 && depths[other] > 0.0 && std::abs(depth - depths[other]) > 15.0;
      if (edge && random.uniform() < noise.flying_share) {
        depth += random.uniform() * (depths[other] - depth);
      }
    }
    depth += random.normal() * noise.axial_per_mm * depth * depth;
    if (random.uniform() < noise.dropout_share) depth = 0.0;
    const double raw = std::round(depth / unit_mm);
    frame.raw.push_back(static_cast<std::uint16_t>(std::clamp(raw, 0.0, 65535.0)));
  }
  return frame;
}

}  // namespace instep
