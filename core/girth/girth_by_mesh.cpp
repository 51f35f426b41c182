#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/geometry/polygon.h"
#include "core/girth/band/crowd_average.h"
#include "core/girth/band/plane_band.h"
#include "core/girth/contour/loop_choice.h"
#include "core/girth/contour/mesh_section.h"
#include "core/girth/contour/section_gaps.h"
#include "core/girth/girth.h"
#include "core/girth/section/unseen_side.h"
#include "core/surface/mesh/grown_mesh.h"

namespace instep {
namespace {

/// Half-width of what is meshed: the triangles at the plane are then as they would be in a mesh of
/// the whole body.
constexpr double kMeshedInSpacings = 4.0;
/// A stretch without a seen point that is worth a warning, in spacings.
constexpr double kNotableGapInSpacings = 6.0;
/// A hole in the mesh, in spacings, that is worth one too if it is this part of a small tape.
constexpr double kHoleInSpacings = 4.0;
constexpr double kNotableHole = 0.05;
/// Noise up to this part of the spacing hardly roughens a mesh.
constexpr double kHarmlessNoise = 0.05;
/// A surface is cut into few pieces; what falls into more is a crowd of points without one.
constexpr std::size_t kMostPieces = 100;
/// Crumbs of mesh that noise lifts off the skin close on themselves, whatever their shape.
constexpr double kOfCrumbs = 1.0;

/// The part of a band that is meshed, in the band's own coordinates.
struct MeshedBand {
  TriangleMesh mesh;
  std::vector<bool> seen;  ///< for each corner
};

MeshedBand mesh_of(const PlaneBand& band) {
  std::vector<Eigen::Vector3d> places;
  std::vector<bool> seen;
  const CrowdAverage average = average_crowds(band);
  for (std::size_t i = 0; i < average.points.size(); ++i) {
    const auto& place = average.points[i].position;
    if (std::abs(place.z()) > kMeshedInSpacings * band.grain) continue;
    places.push_back(place);
    seen.push_back(average.seen[i]);
  }
  return {grow_mesh(places), std::move(seen)};
}

/// The tape plane in the band's coordinates.
TapePlane plane_of_band() {
  return TapePlane::through({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).value();
}

tl::unexpected<Error> no_mesh() {
  return fail(ErrorCode::kInsufficientData,
              "the points near the tape plane form no surface that a mesh could follow",
              "scan again, or use the rbf method");
}

/// The lines in which the plane cuts the mesh, with its holes bridged as far as is allowed.
Result<std::vector<SectionLine>> section_of(const TriangleMesh& mesh, const PlaneBand& band) {
  std::vector<Eigen::Vector2d> crossings;
  const auto pieces = cut(mesh, plane_of_band(), {});
  for (const auto& piece : pieces) {
    crossings.insert(crossings.end(), piece.points.begin(), piece.points.end());
  }
  if (pieces.empty() || pieces.size() > kMostPieces) return no_mesh();
  const double tape = perimeter(convex_hull(std::move(crossings)));
  auto lines = cut(mesh, plane_of_band(), {.widest = kWidestBridge * tape, .own = kOfCrumbs});
  if (!lines.front().closed) return does_not_close(band);
  return lines;
}

/// Longest stretch of a contour on the tape plane without a seen corner of a triangle that the
/// plane cuts, in millimetres.
double gap_under(const std::vector<Eigen::Vector2d>& contour, const PlaneBand& band,
                 const MeshedBand& meshed) {
  const auto& places = meshed.mesh.positions;
  std::vector<bool> counts(places.size(), false);
  double longest_edge = 0.0;
  for (const auto& corners : meshed.mesh.triangles) {
    const auto above = std::count_if(corners.begin(), corners.end(),
                                     [&](auto corner) { return places[corner].z() >= 0.0; });
    if (above == 0 || above == 3) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      counts[corners[k]] = meshed.seen[corners[k]];
      const double edge = (places[corners[k]] - places[corners[(k + 1) % 3]]).norm();
      longest_edge = std::max(longest_edge, edge);
    }
  }
  std::vector<Eigen::Vector2d> evidence;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (counts[i]) evidence.push_back(band.to_plane(places[i].head<2>()));
  }
  return largest_gap(contour, evidence, band.unit_mm * longest_edge);
}

}  // namespace

Result<Girth> girth_by_mesh(const PointCloud& cloud, const TapePlane& plane,
                            const GirthOptions& options) {
  if (auto sound = check_cloud(cloud); !sound) return tl::make_unexpected(sound.error());
  if (auto sound = check_options(options); !sound) return tl::make_unexpected(sound.error());
  SlabSource slabs(cloud, plane, options.sigma_mm);
  const auto band = band_at(slabs);
  if (!band) return tl::make_unexpected(band.error());
  const MeshedBand meshed = mesh_of(*band);
  auto lines = section_of(meshed.mesh, *band);
  if (!lines) return tl::make_unexpected(lines.error());

  for (auto& line : *lines) {
    for (auto& point : line.points) point = band->to_plane(point);
  }
  Girth girth;
  SectionLine loop = choose_loop(std::move(*lines), plane, girth.warnings);
  girth.contour = std::move(loop.points);
  const auto hull = convex_hull(girth.contour);
  if (!is_ring(hull)) return no_mesh();
  girth.contact_mm = perimeter(girth.contour);
  girth.stretched_mm = perimeter(hull);
  girth.points = cloud.size();
  girth.band_points = band->points_taken();
  girth.sigma_mm = band->noise_mm();
  const double seam = band->unit_mm * loop.widest_seam;
  girth.largest_gap_mm = std::max(gap_under(girth.contour, *band, meshed), seam);
  const double spacing = band->unit_mm * band->grain;
  if (girth.largest_gap_mm > kNotableGapInSpacings * spacing ||
      seam > std::max(kHoleInSpacings * spacing, kNotableHole * girth.stretched_mm)) {
    girth.warnings.emplace_back(kBridgedWarning);
  }
  for (auto& disbelief : disbelief_of(*band)) girth.warnings.push_back(std::move(disbelief));
  if (band->sigma > kHarmlessNoise * band->grain) {
    girth.warnings.push_back(
        "a mesh follows the noise of its points, so both lengths are too long");
  }
  return girth;
}

}  // namespace instep
