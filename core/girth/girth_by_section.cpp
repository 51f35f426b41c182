#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/polygon.h"
#include "core/girth/contour/loop_choice.h"
#include "core/girth/contour/mesh_section.h"
#include "core/girth/girth.h"

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

/// Whether the body is what is open: there is no loop, or the open pieces are longer together than
/// the largest and their hull goes round more. One wall beside a body goes round nothing.
bool is_open(const std::vector<SectionLine>& lines) {
  std::vector<Eigen::Vector2d> open;
  double open_length = 0.0;
  double largest_loop = 0.0;
  double loop_length = 0.0;
  for (const auto& line : lines) {
    if (!line.closed) {
      open.insert(open.end(), line.points.begin(), line.points.end());
      open_length += line.length();
    } else if (const double area = std::abs(signed_area(line.points)); area > largest_loop) {
      largest_loop = area;
      loop_length = line.length();
    }
  }
  if (!(largest_loop > 0.0)) return true;
  return open_length > loop_length && signed_area(convex_hull(std::move(open))) > largest_loop;
}

Girth closed_girth(std::vector<SectionLine> lines, const TapePlane& plane, double harmless_seam) {
  Girth girth;
  const auto open = std::count_if(lines.begin(), lines.end(),
                                  [](const SectionLine& line) { return !line.closed; });
  SectionLine loop = choose_loop(std::move(lines), plane, girth.warnings);
  girth.largest_gap_mm = loop.widest_seam;
  girth.contour = std::move(loop.points);
  girth.contact_mm = perimeter(girth.contour);
  girth.stretched_mm = perimeter(convex_hull(girth.contour));
  if (open > 0) {
    girth.warnings.push_back(std::to_string(open) + " open pieces of the section do not count");
  }
  if (girth.largest_gap_mm > harmless_seam) {
    girth.warnings.emplace_back("faces that are not stitched leave gaps, which were bridged");
  }
  return girth;
}

/// From piece to piece round the section.
double widest_gap(std::vector<SectionLine> pieces) {
  double widest = 0.0;
  for (const auto& round :
       stitched(std::move(pieces), {.widest = std::numeric_limits<double>::infinity()})) {
    const double left = round.closed ? 0.0 : (round.points.front() - round.points.back()).norm();
    widest = std::max({widest, round.widest_seam, left});
  }
  return widest;
}

/// The hull closes what the pieces leave open.
Girth open_girth(std::vector<SectionLine> lines) {
  Girth girth;
  for (const auto& line : lines) {
    if (line.closed) girth.warnings.push_back(other_loop_warning(line.length()));
  }
  std::erase_if(lines, [](const SectionLine& line) { return line.closed; });
  std::vector<Eigen::Vector2d> points;
  for (const auto& line : lines) {
    girth.contact_mm += line.length();
    points.insert(points.end(), line.points.begin(), line.points.end());
  }
  girth.contour = convex_hull(std::move(points));
  girth.stretched_mm = perimeter(girth.contour);
  girth.largest_gap_mm = widest_gap(std::move(lines));
  girth.warnings.emplace_back(
      "the section is open: the stretched length bridges it, the contact length is that of the "
      "pieces");
  return girth;
}

}  // namespace

Result<Girth> girth_by_section(const TriangleMesh& mesh, const TapePlane& plane) {
  if (auto sound = check_mesh(mesh); !sound) return tl::make_unexpected(sound.error());
  const auto raw = cut(mesh, plane, {});
  const double size = diagonal(raw);
  auto lines = cut(mesh, plane, {.widest = kWidestSeam * size});
  if (lines.empty() || !(size > 0.0)) {
    return fail(ErrorCode::kInvalidInput, "the tape plane cuts no face of the mesh",
                "give control points on the body");
  }
  Girth girth = is_open(lines) ? open_girth(std::move(lines))
                               : closed_girth(std::move(lines), plane, kHarmlessSeam * size);
  if (!is_ring(convex_hull(girth.contour))) {
    return fail(ErrorCode::kInvalidInput, "the tape plane cuts no ring of faces",
                "give control points on the body");
  }
  girth.points = mesh.positions.size();
  return girth;
}

}  // namespace instep
