#include "tests/bench/feet/girth_parts.h"

#include <optional>

#include "core/foot/measures/standing_girth.h"
#include "sim/section_contour.h"
#include "sim/solids/foot_solid.h"

namespace instep::bench {
namespace {

using Eigen::Vector3d;

/// A point within the body where a found tape lies: the middle of its section.
std::optional<double> solid_girth(const FootSolid& solid, const Measure& measure,
                                  const RigidTransform& solid_from_foot) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const auto& corner : measure.girth->contour) middle += corner;
  middle /= static_cast<double>(measure.girth->contour.size());
  const Vector3d inside = solid_from_foot * measure.plane->lift(middle);
  const auto contour = trace_section(solid, measure.plane->transformed(solid_from_foot), inside);
  return contour ? std::optional(contour->stretched_mm) : std::nullopt;
}

std::optional<double> scanned_girth(const FootScan& foot, const TapePlane& plane) {
  auto girth = girth_by_rbf(foot.cloud, plane);
  if (!girth) return std::nullopt;
  if (foot.cloud.stands_on_platform()) girth = standing_girth(*std::move(girth), plane);
  return girth->stretched_mm;
}

}  // namespace

std::map<std::string, GirthParts> girth_parts(const test::DrawnFoot& drawn, std::uint64_t seed,
                                              const FootScan& foot, const MeasureSet& set) {
  const FootSolid solid(draw_foot(seed, drawn.truth.side));
  const RigidTransform solid_from_foot =
      drawn.input_from_solid.inverse() * foot.foot_from_input.inverse();
  const RigidTransform found_from_true =
      solid_from_foot.inverse() * drawn.truth.foot_from_solid.inverse();
  std::map<std::string, GirthParts> parts;
  for (const auto& [id, points] : drawn.truth.planes) {
    const Measure* measure = set.find(id);
    const auto true_plane = TapePlane::through(points[0], points[1], points[2]);
    if (measure == nullptr || !measure->girth || !true_plane) continue;
    const auto at_found = solid_girth(solid, *measure, solid_from_foot);
    const auto scanned = scanned_girth(foot, true_plane->transformed(found_from_true));
    if (!at_found || !scanned) continue;
    const double truth = drawn.truth.measures.at(id);
    parts[id] = {*at_found - truth, *scanned - truth};
  }
  return parts;
}

}  // namespace instep::bench
