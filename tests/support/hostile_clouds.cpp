#include "tests/support/hostile_clouds.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tests/support/analytic_shapes.h"
#include "tests/support/random_numbers.h"

namespace instep::test {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double angle_of(const Vector3d& place) {
  return std::atan2(place.y(), place.x());
}

Vector3d outward(const Vector3d& place) {
  return Vector3d(place.x(), place.y(), 0.0).normalized();
}

Vector3d any_direction(RandomNumbers& random) {
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

HostileCloud on_cylinder(PointCloud cloud, TapePlane plane = level_plane()) {
  return {std::move(cloud), std::move(plane), kCylinderGirth};
}

HostileCloud no_body(std::vector<Vector3d> positions, TapePlane plane = level_plane()) {
  HostileCloud hostile{{}, std::move(plane), std::nullopt};
  hostile.cloud.positions = std::move(positions);
  return hostile;
}

HostileCloud with_coordinate(double value) {
  PointCloud cloud = cylinder(3000);
  cloud.positions[1234].y() = value;
  return {std::move(cloud), level_plane(), std::nullopt};
}

HostileCloud with_normal(const Vector3d& normal) {
  PointCloud cloud = cylinder(3000);
  for (const auto& position : cloud.positions) cloud.normals.push_back(outward(position));
  cloud.normals[1234] = normal;
  return {std::move(cloud), level_plane(), std::nullopt};
}

HostileCloud with_view(const Vector3d& view) {
  PointCloud cloud = cylinder(3000);
  for (const auto& position : cloud.positions) cloud.view_directions.push_back(outward(position));
  cloud.view_directions[1234] = view;
  return {std::move(cloud), level_plane(), std::nullopt};
}

HostileCloud with_sigma(double sigma) {
  PointCloud cloud = cylinder(3000);
  cloud.sigma_mm.assign(cloud.size(), 0.1);
  cloud.sigma_mm[1234] = sigma;
  return {std::move(cloud), level_plane(), std::nullopt};
}

/// Copies of the first `part` of a cylinder's points, shaken by up to `reach`.
HostileCloud with_copies(double part, double reach) {
  PointCloud cloud = cylinder(4000);
  RandomNumbers random(31);
  const auto count = static_cast<std::size_t>(part * static_cast<double>(cloud.size()));
  for (std::size_t i = 0; i < count; ++i) {
    cloud.positions.push_back(cloud.positions[i] +
                              random.uniform(0.0, reach) * any_direction(random));
  }
  return on_cylinder(std::move(cloud));
}

/// A cylinder, and a crowd of `count` points within `reach` of one place of it.
HostileCloud with_crowd(std::size_t count, double reach, const Vector3d& place) {
  PointCloud cloud = cylinder(2000);
  RandomNumbers random(32);
  for (std::size_t i = 0; i < count; ++i) {
    cloud.positions.push_back(place + random.uniform(0.0, reach) * any_direction(random));
  }
  return on_cylinder(std::move(cloud));
}

/// `count` points in a box round the origin; flat or thin where the half-sides are.
HostileCloud scattered(std::size_t count, const Vector3d& half_sides, const Vector3d& middle) {
  RandomNumbers random(33);
  std::vector<Vector3d> places;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d place(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    places.push_back(middle + half_sides.cwiseProduct(place));
  }
  return no_body(std::move(places));
}

HostileCloud line(const Vector3d& direction, double noise) {
  RandomNumbers random(34);
  std::vector<Vector3d> places;
  for (int i = -500; i <= 500; ++i) {
    places.push_back(Vector3d(0, 0, 1.3) + 0.1 * i * direction + noise * any_direction(random));
  }
  return no_body(std::move(places));
}

/// A single row of points: one scan line round the body, in the plane.
HostileCloud one_ring() {
  return {rings(300, 1, 0.0), level_plane(0.0), kCylinderGirth};
}

/// Nothing but a helix of points round the body, ten millimetres from turn to turn.
HostileCloud one_winding_line() {
  PointCloud cloud;
  for (int i = 0; i < 6000; ++i) {
    const double angle = 2.0 * kPi * i / 1000.0;
    cloud.positions.emplace_back(40 * std::cos(angle), 40 * std::sin(angle), i / 100.0 - 30.0);
  }
  return on_cylinder(std::move(cloud));
}

HostileCloud two_shells(double inner_radius) {
  PointCloud cloud = cylinder(4000);
  cloud.append(
      random_points(elliptic_cylinder(inner_radius, inner_radius), 4000, -30, 30, 0.0, 35));
  return on_cylinder(std::move(cloud));
}

/// Normals that point the wrong way, all or every other one.
HostileCloud inside_out(bool all) {
  PointCloud cloud = cylinder(4000);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double turn = all || i % 2 == 0 ? -1.0 : 1.0;
    cloud.normals.push_back(turn * outward(cloud.positions[i]));
  }
  return on_cylinder(std::move(cloud));
}

HostileCloud seen_from_inside() {
  PointCloud cloud = cylinder(4000);
  for (const auto& position : cloud.positions) cloud.view_directions.push_back(-outward(position));
  return on_cylinder(std::move(cloud));
}

/// Points `fine` apart on the part of the body up to `half_angle` from the x axis, and a hundred
/// times further apart on the rest.
HostileCloud uneven(double fine, double half_angle) {
  const double coarse = 100.0 * fine;
  const double area = 80.0 * kPi * 60.0;
  RandomNumbers random(36);
  PointCloud cloud;
  const auto add = [&](std::size_t count, double from, double to) {
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = random.uniform(from, to);
      cloud.positions.emplace_back(40 * std::cos(angle), 40 * std::sin(angle),
                                   random.uniform(-30, 30));
    }
  };
  const double part = half_angle / kPi;
  add(static_cast<std::size_t>(part * area / (fine * fine)), -half_angle, half_angle);
  add(static_cast<std::size_t>((1.0 - part) * area / (coarse * coarse)), half_angle,
      2.0 * kPi - half_angle);
  return on_cylinder(std::move(cloud));
}

/// One point in twenty lies elsewhere.
HostileCloud with_outliers(const std::function<Vector3d(const Vector3d&, RandomNumbers&)>& moved) {
  PointCloud cloud = cylinder(6000, 0.1);
  RandomNumbers random(37);
  for (std::size_t i = 0; i < cloud.size(); i += 20) {
    cloud.positions[i] = moved(cloud.positions[i], random);
  }
  return on_cylinder(std::move(cloud));
}

HostileCloud without_arc(double half_angle) {
  PointCloud cloud = cylinder(6000);
  std::erase_if(cloud.positions,
                [&](const Vector3d& p) { return std::abs(angle_of(p)) < half_angle; });
  return on_cylinder(std::move(cloud));
}

/// A body that the plane cuts in no ring.
HostileCloud without_ring(PointCloud cloud, TapePlane plane) {
  return {std::move(cloud), std::move(plane), std::nullopt};
}

/// A ball of radius 40 mm cut `depth` below its top; in a circle where that is above 0.
HostileCloud ball_cut(double depth) {
  HostileCloud hostile;
  RandomNumbers random(38);
  for (int i = 0; i < 6000; ++i) hostile.cloud.positions.push_back(40 * any_direction(random));
  hostile.plane = level_plane(40.0 - depth);
  if (depth > 0.0) hostile.truth_mm = 2.0 * kPi * std::sqrt(depth * (80.0 - depth));
  return hostile;
}

/// Beside the cylinder another body, smaller by the factor.
HostileCloud two_bodies(double factor, double distance) {
  PointCloud cloud = cylinder(4000);
  for (const auto& position :
       random_points(elliptic_cylinder(40 * factor, 40 * factor), 3000, -30, 30, 0.0, 39)
           .positions) {
    cloud.positions.push_back(position + Vector3d(distance, 0, 0));
  }
  return on_cylinder(std::move(cloud));
}

HostileCloud in_unit(double factor) {
  HostileCloud hostile = on_cylinder(cylinder(4000), level_plane(1.3 * factor));
  for (auto& position : hostile.cloud.positions) position *= factor;
  hostile.truth_mm = factor * kCylinderGirth;
  return hostile;
}

/// Far from the origin, where doubles are coarser.
HostileCloud far_away() {
  const Vector3d there(9e4, -9e4, 9e4);
  PointCloud cloud = cylinder(4000);
  for (auto& position : cloud.positions) position += there;
  return on_cylinder(std::move(cloud),
                     plane_at(there, there + Vector3d::UnitX(), there + Vector3d::UnitY()));
}

TapePlane along_the_axis(double x) {
  return plane_at({x, 0, 0}, {x, 1, 0}, {x, 0, 1});
}

}  // namespace

std::vector<HostileCase> unmeasurable_clouds() {
  const Vector3d middle(0, 0, 1.3);
  return {
      {"NaNCoordinate", [] { return with_coordinate(kNan); }},
      {"InfiniteCoordinate", [] { return with_coordinate(kInfinity); }},
      {"MinusInfiniteCoordinate", [] { return with_coordinate(-kInfinity); }},
      {"AbsurdCoordinate", [] { return with_coordinate(1e300); }},
      {"NaNNormal", [] { return with_normal(Vector3d(kNan, 0.0, 1.0)); }},
      {"ZeroNormal", [] { return with_normal(Vector3d(0, 0, 0)); }},
      {"NaNView", [] { return with_view(Vector3d(0.0, kNan, 1.0)); }},
      {"NaNSigma", [] { return with_sigma(kNan); }},
      {"ZeroSigma", [] { return with_sigma(0.0); }},
      {"InfiniteSigma", [] { return with_sigma(kInfinity); }},
      {"NoPoint", [] { return no_body({}); }},
      {"OnePoint",
       [] {
         return no_body({{40, 0, 1.3}});
       }},
      {"ThreePoints",
       [] {
         return no_body({{40, 0, 0}, {-20, 30, 3}, {-20, -30, 1}});
       }},
      {"ThreePointsOnThePlane",
       [] {
         return no_body({{40, 0, 1.3}, {-20, 30, 1.3}, {-20, -30, 1.3}});
       }},
      {"AllTheSamePoint",
       [] {
         return no_body(std::vector<Vector3d>(5000, {3, 4, 1.3}));
       }},
      {"CollinearAcross", [] { return line(Vector3d(0, 0, 1), 0.0); }},
      {"CollinearInThePlane", [] { return line(Vector3d(1, 0, 0), 0.0); }},
      {"CollinearOblique", [] { return line(Vector3d(0.6, 0, 0.8), 0.0); }},
      {"CollinearAlmost", [] { return line(Vector3d(0.6, 0, 0.8), 1e-6); }},
      {"CollinearButForRounding", [] { return line(Vector3d(0, 0, 1), 3e-11); }},
      {"CoplanarAcross", [=] { return scattered(3000, Vector3d(50, 0, 50), middle); }},
      {"CoplanarAlmostAcross", [=] { return scattered(3000, Vector3d(50, 1e-6, 50), middle); }},
      {"PlaneMisses", [] { return without_ring(cylinder(4000), level_plane(80)); }},
      {"PlaneJustMisses", [] { return without_ring(cylinder(4000), level_plane(30.5)); }},
      {"PlaneTouchesTheSide", [] { return without_ring(cylinder(4000), along_the_axis(40)); }},
      {"PlaneTouchesABall", [] { return ball_cut(0.0); }},
  };
}

std::vector<HostileCase> ringless_clouds() {
  const Vector3d middle(0, 0, 1.3);
  return {
      {"CoplanarInThePlane", [=] { return scattered(3000, Vector3d(50, 50, 0), middle); }},
      {"CoplanarAlmostInThePlane", [=] { return scattered(3000, Vector3d(50, 50, 0.01), middle); }},
      {"FilledCube", [=] { return scattered(5000, Vector3d(40, 40, 40), middle); }},
      {"PlaneGrazesTheSide", [] { return without_ring(cylinder(4000), along_the_axis(39.5)); }},
      {"PlaneAlongTheAxis", [] { return without_ring(cylinder(4000), along_the_axis(0)); }},
  };
}

std::vector<HostileCase> spoilt_clouds() {
  const Vector3d here(40, 0, 1.3);
  const Vector3d beside(40, 0, 1.4);
  const Vector3d away(0, 40, 20);
  return {
      {"AllTwice", [] { return with_copies(1.0, 0.0); }},
      {"HalfTwice", [] { return with_copies(0.5, 0.0); }},
      {"AllTwiceAlmost", [] { return with_copies(1.0, 1e-9); }},
      {"HalfTwiceAlmost", [] { return with_copies(0.5, 1e-6); }},
      {"HalfTwiceNear", [] { return with_copies(0.5, 0.01); }},
      {"CrowdAtOnePlace", [=] { return with_crowd(50000, 0.0, here); }},
      {"CrowdNearOnePlace", [=] { return with_crowd(50000, 1e-9, here); }},
      {"CrowdWithinAMicrometre", [=] { return with_crowd(50000, 1e-3, here); }},
      {"CrowdWithinHalfAMillimetre", [=] { return with_crowd(50000, 0.5, here); }},
      {"CrowdBesideThePlane", [=] { return with_crowd(50000, 1e-3, beside); }},
      {"CrowdAwayFromThePlane", [=] { return with_crowd(50000, 1e-6, away); }},
      {"OneRing", one_ring},
      {"OneWindingLine", one_winding_line},
      {"TwoShells", [] { return two_shells(37.0); }},
      {"TwoShellsAlmostTouching", [] { return two_shells(39.7); }},
      {"InsideOut", [] { return inside_out(true); }},
      {"HalfInsideOut", [] { return inside_out(false); }},
      {"SeenFromInside", seen_from_inside},
      {"TwoBodies", [] { return two_bodies(0.5, 90.0); }},
      {"TwoBodiesAlmostTouching", [] { return two_bodies(0.9, 77.0); }},
      {"ThousandTimesTooSmall", [] { return in_unit(1e-3); }},
      {"ThousandTimesTooLarge", [] { return in_unit(1e3); }},
      {"FarFromTheOrigin", far_away},
      {"SpacingUnevenByAHundredOnHalf", [] { return uneven(0.2, 0.5 * kPi); }},
      {"SpacingUnevenByAHundredOnAQuarter", [] { return uneven(0.1, 0.25 * kPi); }},
      {"SpacingUnevenByAHundredOnAPatch", [] { return uneven(0.06, 0.1); }},
      {"OutliersAnywhere",
       [] {
         return with_outliers([](const Vector3d& place, RandomNumbers& random) {
           return Vector3d(place + 20.0 * any_direction(random));
         });
       }},
      {"OutliersOutwards",
       [] {
         return with_outliers([](const Vector3d& place, RandomNumbers&) {
           return Vector3d(place + 20.0 * outward(place));
         });
       }},
      {"OutliersInwards",
       [] {
         return with_outliers([](const Vector3d& place, RandomNumbers&) {
           return Vector3d(place - 20.0 * outward(place));
         });
       }},
      {"OutliersInOneLump",
       [] {
         return with_outliers([](const Vector3d&, RandomNumbers& random) {
           return Vector3d(Vector3d(60, 0, 0) + 2.0 * any_direction(random));
         });
       }},
      {"OutliersInALumpBeforeTheBody",
       [] {
         return with_outliers([](const Vector3d&, RandomNumbers& random) {
           return Vector3d(Vector3d(-70, 0, 0) + 2.0 * any_direction(random));
         });
       }},
      {"RowsWithThePlaneBetween",
       [] {
         PointCloud rows;
         RandomNumbers random(5);
         for (int row = -30; row <= 30; ++row) {
           for (int i = 0; i < 1500; ++i) {
             const double angle = random.uniform(0.0, 2.0 * kPi);
             rows.positions.emplace_back(40 * std::cos(angle), 40 * std::sin(angle), row);
           }
         }
         return on_cylinder(std::move(rows), level_plane(0.5));
       }},
      {"OpenByATenth", [] { return without_arc(0.1 * kPi); }},
      {"OpenByAQuarter", [] { return without_arc(0.25 * kPi); }},
      {"OpenByAThird", [] { return without_arc(kPi / 3.0); }},
      {"OpenByHalf", [] { return without_arc(0.5 * kPi); }},
      {"OpenByNineTenths", [] { return without_arc(0.9 * kPi); }},
      {"PlaneAlongTheEdge", [] { return on_cylinder(cylinder(4000), level_plane(30)); }},
      {"PlaneJustInsideTheEdge", [] { return on_cylinder(cylinder(4000), level_plane(29.8)); }},
      {"PlaneGrazesABall", [] { return ball_cut(0.1); }},
      {"PlaneCutsTheTipOfABall", [] { return ball_cut(2.0); }},
  };
}

}  // namespace instep::test
