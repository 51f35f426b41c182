#include "tests/support/cases/case_bodies.h"

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/places.h"

namespace instep::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Enough for chords to lose less than 0.00002 mm of a smooth section.
constexpr int kRays = 6000;
/// Enough for a crease to lose less than 0.005 mm between two rays.
constexpr int kRaysOfCreased = 20000;
constexpr double kMostTiltDegrees = 15.0;

/// Of the turns at a fine polygon's corners.
double bending_of(const std::vector<Vector2d>& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d before = polygon[i] - polygon[(i + polygon.size() - 1) % polygon.size()];
    const Vector2d after = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double turn =
        std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
    sum += turn * turn / (0.5 * (before.norm() + after.norm()));
  }
  return sum;
}

CaseBody analytic_body(std::string name, const AnalyticShape& shape, int rays = kRays) {
  return {.name = std::move(name),
          .crowd =
              [shape](std::size_t count, std::uint64_t seed) {
                return points_by_area(shape, count, -kHalfLengthMm, kHalfLengthMm, seed);
              },
          .plane = [](RandomNumbers& random) { return tilted_plane(kMostTiltDegrees, random); },
          .lengths = [shape, rays](const TapePlane& plane) -> std::optional<TrueLengths> {
            const auto section = true_section(shape, plane, rays);
            const auto hull = convex_hull(section);
            return TrueLengths{perimeter(hull), perimeter(section), bending_of(hull)};
          }};
}

/// A known section's plane, moved along the foot and tilted.
TapePlane moved_plane(const TapePlane& plane, RandomNumbers& random) {
  const Vector3d place = plane.origin() + random.uniform(-8.0, 8.0) * plane.normal();
  return plane_at(place, tilted(plane.normal(), 8.0, random));
}

}  // namespace

TapePlane plane_at(const Vector3d& place, const Vector3d& normal) {
  const Vector3d u = normal.unitOrthogonal();
  return TapePlane::through(place, place + 10.0 * u, place + 10.0 * normal.cross(u)).value();
}

Vector3d tilted(const Vector3d& axis, double most_degrees, RandomNumbers& random) {
  const double tilt = most_degrees * std::numbers::pi / 180.0 * std::sqrt(random.uniform());
  const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
  const Vector3d across = Eigen::AngleAxisd(turn, axis) * axis.unitOrthogonal();
  return Eigen::AngleAxisd(tilt, across) * axis;
}

TapePlane tilted_plane(double most_degrees, RandomNumbers& random) {
  const double z = random.uniform(-5.0, 5.0);
  return plane_at({0, 0, z}, tilted(Vector3d::UnitZ(), most_degrees, random));
}

std::vector<CaseBody> smooth_bodies(std::uint64_t seed) {
  RandomNumbers random(seed);
  const auto about = [&](double plain) {
    return seed == 0 ? plain : plain * random.uniform(0.85, 1.15);
  };
  const double sphere = about(42);
  const double cylinder = about(40);
  std::vector<CaseBody> bodies;
  bodies.push_back(analytic_body("cylinder", elliptic_cylinder(cylinder, cylinder)));
  bodies.push_back(analytic_body("ellipse", elliptic_cylinder(about(48), about(28))));
  bodies.push_back(analytic_body("cone", cone(about(38), about(0.25))));
  bodies.push_back(analytic_body("sphere", ellipsoid(sphere, sphere, sphere)));
  bodies.push_back(analytic_body("ellipsoid", ellipsoid(about(50), about(35), about(70))));
  bodies.push_back(analytic_body("superellipse", superellipse(about(42), about(38), about(3.0))));
  bodies.push_back(analytic_body("bent tube", bent_tube(about(90), about(35))));
  bodies.push_back(analytic_body("lobed", lobed_cylinder(about(40), about(6), 3)));
  return bodies;
}

CaseBody creased_body(std::uint64_t seed) {
  RandomNumbers random(seed);
  return analytic_body(
      "creased",
      flat_soled_cylinder(random.uniform(40, 50), random.uniform(30, 40), random.uniform(15, 25)),
      kRaysOfCreased);
}

std::vector<CaseBody> scanned_feet() {
  std::vector<CaseBody> feet;
  for (const std::string file : {"retail_left.stl", "retail_right.stl"}) {
    const auto mesh =
        std::make_shared<const TriangleMesh>(read_shape(trial_data() / "feet" / file, 1000.0).mesh);
    std::vector<TapePlane> planes;
    for (const auto& section : known_sections("feet")) {
      if (section.file == file) planes.push_back(section.plane);
    }
    feet.push_back({.name = "foot",
                    .crowd =
                        [mesh](std::size_t count, std::uint64_t seed) {
                          return oriented_points_on(*mesh, count, 0.0, seed);
                        },
                    .plane =
                        [planes](RandomNumbers& random) {
                          return moved_plane(planes[random.below(planes.size())], random);
                        },
                    .lengths = [mesh](const TapePlane& plane) -> std::optional<TrueLengths> {
                      const auto girth = girth_by_section(*mesh, plane);
                      if (!girth || !girth->warnings.empty()) return std::nullopt;
                      return TrueLengths{girth->stretched_mm, girth->contact_mm, 0.0};
                    }});
  }
  return feet;
}

}  // namespace instep::test
