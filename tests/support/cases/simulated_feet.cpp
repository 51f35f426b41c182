#include "tests/support/cases/simulated_feet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>

#include "core/surface/marching_cubes.h"
#include "sim/section_contour.h"
#include "sim/solids/foot_solid.h"
#include "tests/support/shape_files.h"

namespace instep::test {
namespace {

using Eigen::Vector3d;

constexpr double kCutMm = 100.0;
/// Fine enough to spread points evenly; they are moved to the skin afterwards.
constexpr double kCubeMm = 4.0;

TriangleMesh rough_mesh(const FootSolid& foot) {
  Eigen::AlignedBox3d box = foot.bounds();
  box.max().z() = std::min(box.max().z(), kCutMm);
  return march_cubes(CubeGrid::covering(box, kCubeMm).value(),
                     {[&](const Vector3d& place) { return -foot.value(place); },
                      [&](const Eigen::Vector3i&) { return true; },
                      {}});
}

/// Moves points to the skin and gives them its normals.
void settle(const FootSolid& foot, PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Vector3d& place = cloud.positions[i];
    Vector3d slope = foot.gradient(place);
    for (int step = 0; step < 20; ++step) {
      const double value = foot.value(place);
      if (std::abs(value) < 1e-7) break;
      slope = foot.gradient(place);
      place -= value / slope.squaredNorm() * slope;
    }
    cloud.normals[i] = slope.normalized();
  }
}

/// Between instep and ball, across the foot.
TapePlane drawn_plane(double length_mm, RandomNumbers& random) {
  constexpr double kMostTiltDegrees = 15.0;
  const Vector3d place(length_mm * random.uniform(0.50, 0.72), 0.0, 15.0);
  return plane_at(place, tilted(Vector3d::UnitX(), kMostTiltDegrees, random));
}

}  // namespace

std::vector<CaseBody> simulated_feet(std::size_t count) {
  constexpr double kStepMm = 0.05;
  std::vector<CaseBody> feet;
  for (std::size_t i = 0; i < count; ++i) {
    const auto foot = std::make_shared<const FootSolid>(
        draw_foot(i + 1, i % 2 == 0 ? Side::kRight : Side::kLeft));
    const auto mesh = std::make_shared<const TriangleMesh>(rough_mesh(*foot));
    feet.push_back({.name = "simulated foot",
                    .crowd =
                        [mesh](std::size_t points, std::uint64_t seed) {
                          return oriented_points_on(*mesh, points, 0.0, seed);
                        },
                    .plane =
                        [foot](RandomNumbers& random) {
                          return drawn_plane(foot->parameters().length_mm, random);
                        },
                    .lengths = [foot](const TapePlane& plane) -> std::optional<TrueLengths> {
                      const auto contour = trace_section(*foot, plane, plane.origin(), kStepMm);
                      if (!contour) return std::nullopt;
                      return TrueLengths{contour->stretched_mm, contour->contact_mm, 0.0};
                    },
                    .settle = [foot](PointCloud& cloud) { settle(*foot, cloud); }});
  }
  return feet;
}

}  // namespace instep::test
