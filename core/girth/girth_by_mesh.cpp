#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "core/girth/loop_choice.h"
#include "core/girth/mesh_section.h"
#include "core/girth/plane_band.h"
#include "core/girth/section_gaps.h"
#include "core/surface/grown_mesh.h"

namespace instep {
namespace {

/// Half-width of what is meshed: triangles there are as they would be in a mesh of the whole body.
constexpr double kMeshedInSpacings = 4.0;
/// Widest hole that is bridged, against the length of the contour.
constexpr double kWidestBridge = 0.25;
/// Points further from the contour or the plane than this many spacings are no evidence for it.
constexpr double kEvidenceInSpacings = 2.5;
/// A stretch without a seen point that is worth a warning, in spacings.
constexpr double kNotableGapInSpacings = 6.0;

/// The tape plane as the band sees it.
TapePlane plane_of_band() {
  return TapePlane::through({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).value();
}

std::vector<SectionLine> section_of(const PlaneBand& band) {
  std::vector<Eigen::Vector3d> places;
  places.reserve(band.points.size());
  for (const auto& point : band.points) {
    if (std::abs(point.position.z()) < kMeshedInSpacings * band.spacing) {
      places.push_back(point.position);
    }
  }
  const TriangleMesh mesh = grow_mesh(places);
  std::vector<Eigen::Vector2d> outline;
  for (const auto& line : cut(mesh, plane_of_band(), 0.0)) {
    outline.insert(outline.end(), line.points.begin(), line.points.end());
  }
  const double length = perimeter(convex_hull(std::move(outline)));
  return cut(mesh, plane_of_band(), kWidestBridge * length);
}

/// Longest stretch of the contour under which lies no point of the band.
double gap_of(const PlaneBand& band, const std::vector<Eigen::Vector2d>& contour, bool only_seen) {
  const double near = kEvidenceInSpacings * band.spacing;
  std::vector<Eigen::Vector2d> evidence;
  for (std::size_t i = 0; i < band.points.size(); ++i) {
    const auto& position = band.points[i].position;
    if (only_seen && !band.seen[i]) continue;
    if (std::abs(position.z()) < near) evidence.push_back(position.head<2>());
  }
  return largest_gap(contour, evidence, near);
}

}  // namespace

Result<Girth> girth_by_mesh(const PointCloud& cloud, const TapePlane& plane,
                            const GirthOptions& options) {
  if (auto sound = check_cloud(cloud); !sound) return tl::make_unexpected(sound.error());
  const auto band = band_at(cloud, plane, options.sigma_mm);
  if (!band) return tl::make_unexpected(band.error());
  auto lines = section_of(*band);
  if (lines.empty() || !lines.front().closed) {
    return fail(ErrorCode::kInsufficientData, "the section at the tape plane does not close",
                "scan the body all round, or move the plane");
  }

  Girth girth;
  std::vector<std::vector<Eigen::Vector2d>> loops;
  for (auto& line : lines) {
    if (!line.closed) continue;
    for (auto& point : line.points) point = band->to_plane(point);
    loops.push_back(std::move(line.points));
  }
  girth.contour = choose_loop(std::move(loops), girth.warnings);
  girth.contact_mm = perimeter(girth.contour);
  girth.stretched_mm = perimeter(convex_hull(girth.contour));
  girth.points = cloud.size();
  girth.band_points = band->used;
  girth.sigma_mm = band->unit_mm * band->sigma;
  std::vector<Eigen::Vector2d> contour;
  for (const auto& point : girth.contour) {
    contour.push_back((point - band->middle_mm) / band->unit_mm);
  }
  girth.largest_gap_mm = band->unit_mm * gap_of(*band, contour, true);
  return girth;
}

}  // namespace instep
