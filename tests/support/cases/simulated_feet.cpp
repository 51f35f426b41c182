#include "tests/support/cases/simulated_feet.h"

#include <memory>

#include "sim/section_contour.h"
#include "sim/solids/foot_solid.h"
#include "tests/support/cases/foot_skin.h"
#include "tests/support/shape_files.h"

namespace instep::test {
namespace {

using Eigen::Vector3d;

constexpr double kCutMm = 100.0;

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
    const auto mesh = std::make_shared<const TriangleMesh>(rough_skin(*foot, kCutMm));
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
                    .settle = [foot](PointCloud& cloud) { settle_on_skin(*foot, cloud); }});
  }
  return feet;
}

}  // namespace instep::test
