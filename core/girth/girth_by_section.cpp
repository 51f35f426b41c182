#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/geometry/point_cloud.h"
#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "core/girth/loop_choice.h"
#include "core/girth/mesh_section.h"

namespace instep {
namespace {

/// Widest gap between pieces that still counts as skin, against the diagonal of the section: faces
/// that were never stitched leave such seams (up to 7 mm along the featherline of real lasts).
constexpr double kWidestSeam = 0.08;
/// Widest seam that needs no warning, against the diagonal: half a millimetre on a foot.
constexpr double kHarmlessSeam = 0.005;

Result<void> check_mesh(const TriangleMesh& mesh) {
  if (mesh.empty()) {
    return fail(ErrorCode::kInsufficientData, "the mesh has no faces",
                "use a method that works on points");
  }
  for (const auto& position : mesh.positions) {
    if (!position.allFinite() || position.cwiseAbs().maxCoeff() > kLargestCoordinateMm) {
      return fail(ErrorCode::kInvalidInput,
                  "a corner of the mesh is no number or further than 100 m away",
                  "repair or export the mesh again");
    }
  }
  for (const auto& corners : mesh.triangles) {
    if (*std::max_element(corners.begin(), corners.end()) >= mesh.positions.size()) {
      return fail(ErrorCode::kCorruptData, "a face of the mesh names a corner that is not there",
                  "repair or export the mesh again");
    }
  }
  return {};
}

/// Diagonal of the box round all lines.
double diagonal(const std::vector<SectionLine>& lines) {
  Eigen::AlignedBox2d box;
  for (const auto& line : lines) {
    for (const auto& point : line.points) box.extend(point);
  }
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

Girth closed_girth(const std::vector<SectionLine>& lines) {
  std::vector<std::vector<Eigen::Vector2d>> loops;
  std::size_t open = 0;
  for (const auto& line : lines) {
    if (line.closed) {
      loops.push_back(line.points);
    } else {
      ++open;
    }
  }
  Girth girth;
  for (const auto& line : lines) {
    girth.largest_gap_mm = std::max(girth.largest_gap_mm, line.widest_seam);
  }
  girth.contour = choose_loop(std::move(loops), girth.warnings);
  girth.contact_mm = perimeter(girth.contour);
  girth.stretched_mm = perimeter(convex_hull(girth.contour));
  if (open > 0) {
    girth.warnings.push_back(std::to_string(open) + " open pieces of the section do not count");
  }
  return girth;
}

/// The hull closes what the pieces leave open.
Girth open_girth(const std::vector<SectionLine>& lines) {
  Girth girth;
  std::vector<Eigen::Vector2d> points;
  for (const auto& line : lines) {
    girth.contact_mm += line.length();
    points.insert(points.end(), line.points.begin(), line.points.end());
  }
  girth.contour = convex_hull(std::move(points));
  girth.stretched_mm = perimeter(girth.contour);
  for (const auto& line : lines) {
    if (line.closed) continue;
    girth.largest_gap_mm =
        std::max(girth.largest_gap_mm, (line.points.front() - line.points.back()).norm());
  }
  girth.warnings.push_back(
      "the section is open: the stretched length bridges it, the contact length is that of the "
      "pieces");
  return girth;
}

}  // namespace

Result<Girth> girth_by_section(const TriangleMesh& mesh, const TapePlane& plane) {
  if (auto sound = check_mesh(mesh); !sound) return tl::make_unexpected(sound.error());
  const auto raw = cut(mesh, plane, 0.0);
  const double size = diagonal(raw);
  const auto lines = cut(mesh, plane, kWidestSeam * size);
  if (lines.empty() || !(size > 0.0)) {
    return fail(ErrorCode::kInvalidInput, "the tape plane cuts no face of the mesh",
                "give control points on the body");
  }
  const bool open_outweighs = !lines.front().closed;
  Girth girth = open_outweighs ? open_girth(lines) : closed_girth(lines);
  if (!is_ring(convex_hull(girth.contour))) {
    return fail(ErrorCode::kInvalidInput, "the tape plane cuts no ring of faces",
                "give control points on the body");
  }
  if (!open_outweighs && girth.largest_gap_mm > kHarmlessSeam * size) {
    girth.warnings.push_back("faces that are not stitched leave gaps, which were bridged");
  }
  girth.points = mesh.positions.size();
  return girth;
}

}  // namespace instep
