#include "core/girth/open_section.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/plane_vectors.h"
#include "core/geometry/polygon.h"
#include "core/girth/band/plane_band.h"
#include "core/girth/contour/contour_trace.h"
#include "core/girth/contour/section_gaps.h"
#include "core/girth/girth_in_frame.h"
#include "core/girth/section/section_evidence.h"
#include "core/girth/section/section_loops.h"
#include "core/girth/section/section_unknowns.h"
#include "core/girth/section/section_warnings.h"
#include "core/in_millimetres.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {
namespace {

/// An opening, against the hull of the points: of less patches span more.
constexpr double kLeastOpening = 0.1;
/// Steps in grains, between those of a closed section's two rounds.
constexpr double kStep = 0.5;
/// A line along the skin, against the width of the body.
constexpr double kLongestLine = 6.0;
/// Of a line that is more than a stray's.
constexpr std::size_t kFewestCorners = 8;
/// Within so many grains of the plane and the line points tell where the skin ends: further off the
/// rim of an opening has turned up or down.
constexpr double kAtPlane = 1.0;
/// Of the points near the plane, off the line: of a floor or a second body more are.
constexpr double kMostBesideLine = 0.1;
/// What may lie in an opening, against what an arc adds there.
constexpr double kBeyondArc = 2.0;
/// Half of a 95 % interval that leaves nothing to be told, against the length. More than of closed
/// sections: the length along what was seen is sure.
constexpr double kMostDoubtOfOpening = 0.15;
/// Of the stretch beside an end whose direction counts.
constexpr double kFlaring = 0.2;
/// Half of what skin turns in an opening (radians) beyond which the body may as well taper there as
/// be round. Of 167 girths of lasts with a side cut away 32 are off by more than twice the arc;
/// with this limit 120 are told and 7 of these off.
constexpr double kMostHalfTurn = 1.05;
/// The same of either end alone: from here on skin turns away from the opening.
constexpr double kMostTurn = 2.0;

/// A side of the hull of the points near the plane: between its ends lies no point.
struct Opening {
  Eigen::Vector2d from;  ///< counter-clockwise
  Eigen::Vector2d to;
};

std::vector<Eigen::Vector2d> places_near_plane(const PlaneBand& band) {
  std::vector<Eigen::Vector2d> places;
  for (const auto& point : band.points) {
    if (std::abs(point.position.z()) <= evidence_reach(band)) {
      places.emplace_back(point.position.head<2>());
    }
  }
  return places;
}

/// Whether a place lies within `near` of the middle half; beside the ends skin may turn inwards.
bool is_in(const Opening& opening, const Eigen::Vector2d& place, double near) {
  const Eigen::Vector2d across = opening.to - opening.from;
  const double width = across.norm();
  const Eigen::Vector2d arm = place - opening.from;
  const double off_middle = arm.dot(across) / width - 0.5 * width;
  return std::abs(off_middle) < 0.25 * width && std::abs(cross(across, arm)) < near * width;
}

/// The widest; flat skin with points along it is none.
std::optional<Opening> opening_of(const PlaneBand& band) {
  const auto places = places_near_plane(band);
  const auto hull = convex_hull(places);
  if (!is_ring(hull)) return std::nullopt;
  double widest = kLeastOpening * perimeter(hull);
  std::optional<Opening> found;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Opening side{hull[i], hull[(i + 1) % hull.size()]};
    const double width = (side.to - side.from).norm();
    if (width <= widest) continue;
    const bool is_open = std::none_of(places.begin(), places.end(), [&](const auto& place) {
      return is_in(side, place, evidence_reach(band));
    });
    if (!is_open) continue;
    widest = width;
    found = side;
  }
  return found;
}

/// From the one end of the opening to the other, along the skin.
std::optional<Contour> line_beside(const Opening& opening, const PlaneBand& band,
                                   BlendedSurface& surface) {
  const double step = kStep * band.grain;
  const double reach = evidence_reach(band);
  // The first round places the patches, the second reads the finished field.
  const auto draft = trace_open_line(surface, opening.to, step, reach, kLongestLine);
  if (!draft) return std::nullopt;
  auto line = trace_open_line(surface, draft->points.front(), step, reach, kLongestLine);
  if (!line) return std::nullopt;
  const bool leads_across =
      std::any_of(line->points.begin(), line->points.end(),
                  [&](const auto& corner) { return (corner - opening.from).norm() <= reach; });
  return leads_across ? line : std::nullopt;
}

/// The mean direction out of the body beside an end of the line: within `near` of it, but not hard
/// by it, where the surface has points on one side only and flares.
Eigen::Vector2d outward_beside(const Contour& line, const Eigen::Vector2d& end, double near) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const double away = (line.points[i] - end).norm();
    if (away > kFlaring * near && away <= near) sum += line.outward[i];
  }
  return sum;
}

/// Where a tape round the line leaves it, to come back at its other end.
Opening left_by_tape(const Contour& line) {
  const auto number = [&](const Eigen::Vector2d& corner) {
    return std::find(line.points.begin(), line.points.end(), corner);
  };
  const auto hull = convex_hull(line.points);
  const auto [first, last] = std::minmax_element(
      hull.begin(), hull.end(),
      [&](const auto& one, const auto& other) { return number(one) < number(other); });
  return {*last, *first};
}

/// By how much an arc that leaves the line in its direction on both sides of the opening is longer
/// than a tape across it; nothing where an arc tells nothing: the skin turns away from the opening,
/// as a floor beside a sole does, or the body may taper there.
std::optional<double> arc_beyond_chord(const Contour& line, double near) {
  const Opening opening = left_by_tape(line);
  const Eigen::Vector2d across = opening.to - opening.from;
  const Eigen::Vector2d outward(across.y(), -across.x());
  const double leaving = turn_between(outward_beside(line, opening.from, near), outward);
  const double arriving = turn_between(outward, outward_beside(line, opening.to, near));
  if (std::max(std::abs(leaving), std::abs(arriving)) > kMostTurn) return std::nullopt;
  const double half = 0.5 * (leaving + arriving);
  if (half > kMostHalfTurn) return std::nullopt;
  // Skin that turns inwards already at its ends is bridged as any hollow.
  return half > 0.0 ? across.norm() * (half / std::sin(half) - 1.0) : 0.0;
}

/// With corners straight from its end to its beginning.
Contour closed_straight(Contour line, double step) {
  const Eigen::Vector2d from = line.points.back();
  const Eigen::Vector2d across = line.points.front() - from;
  const double width = across.norm();
  const Eigen::Vector2d outward = Eigen::Vector2d(across.y(), -across.x()) / width;
  const int pieces = std::max(2, static_cast<int>(std::ceil(width / step)));
  // The first and the last lie hard by the ends, so that what turns there has no length.
  constexpr double kHardBy = 1e-3;
  for (int i = 0; i <= pieces; ++i) {
    const double part =
        std::clamp(static_cast<double>(i) / pieces, kHardBy / pieces, 1.0 - kHardBy / pieces);
    line.points.emplace_back(from + part * across);
    line.outward.push_back(outward);
  }
  return line;
}

double length_of(const Contour& line) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) length += line.chord(i);
  return length;
}

/// Between two ways along it.
Contour part_of(const Contour& line, double from, double to) {
  Contour part;
  double way = 0.0;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const double chord = line.chord(i);
    const auto add = [&](double along) {
      const double share = along > 0.0 ? along / chord : 0.0;
      part.points.emplace_back((1.0 - share) * line.points[i] + share * line.points[i + 1]);
      part.outward.emplace_back(
          ((1.0 - share) * line.outward[i] + share * line.outward[i + 1]).normalized());
    };
    if (way >= from && way <= to) add(0.0);
    if (way < from && from < way + chord) add(from - way);
    if (way < to && to < way + chord) add(to - way);
    way += chord;
  }
  return part;
}

/// From the first to the last of the points along it: what was followed beyond is no skin that was
/// seen. No corner is left where there are none.
Contour seen_part(const Contour& line, const PlaneBand& band) {
  if (!((line.points.front() - line.points.back()).norm() > 0.0)) return {};
  const ContourIndex closed(closed_straight(line, kStep * band.grain));
  const auto ways = evidence_for(band, closed, kAtPlane * band.grain).ways;
  const auto after = std::upper_bound(ways.begin(), ways.end(), length_of(line));
  if (after == ways.begin()) return {};
  return part_of(line, ways.front(), *std::prev(after));
}

/// The skin on the plane from the one end of its one opening to the other.
std::optional<Contour> open_line(const PlaneBand& band, BlendedSurface& surface) {
  const auto opening = opening_of(band);
  if (!opening) return std::nullopt;
  const auto followed = line_beside(*opening, band, surface);
  if (!followed) return std::nullopt;
  Contour line = seen_part(*followed, band);
  if (line.points.size() < kFewestCorners) return std::nullopt;
  return line;
}

/// As if points lay in the opening, whose doubt is told apart.
SectionEvidence evidence_with_opening(const PlaneBand& band, const SectionLoop& loop,
                                      double way_to_opening) {
  auto evidence = evidence_for(band, loop.index, evidence_reach(band));
  for (double way = way_to_opening; way < loop.index.length(); way += band.grain) {
    evidence.ways.push_back(way);
  }
  std::sort(evidence.ways.begin(), evidence.ways.end());
  evidence.gap = largest_gap_between(evidence.ways, loop.index.length());
  evidence.seen_gap = evidence.gap;
  return evidence;
}

/// By how much a tape round the line is shorter than one that goes round the points in the opening
/// too, beyond the straight way across it and further than skin leans on its way to the plane: a
/// few beside the plane show that the body goes on there.
double missed_by_tape(const Contour& line, const PlaneBand& band) {
  const Opening opening = left_by_tape(line);
  const Eigen::Vector2d across = opening.to - opening.from;
  auto corners = line.points;
  for (const auto& point : band.points) {
    const Eigen::Vector2d place = point.position.head<2>();
    const double beyond = -cross(across, place - opening.from) / across.norm();
    if (beyond > evidence_reach(band) + std::abs(point.position.z())) corners.push_back(place);
  }
  return perimeter(convex_hull(std::move(corners))) - perimeter(convex_hull(line.points));
}

std::string opening_warning(double width_mm) {
  return "the section is open over " + in_millimetres(width_mm) +
         ": the tape is laid straight across, and is longer if the body bulges there, as "
         "the interval allows for, or has an edge there; scan the body from there too";
}

}  // namespace

std::optional<Girth> girth_over_opening(const PointCloud& cloud, const TapePlane& plane,
                                        const GirthOptions& options) {
  SlabSource slabs(cloud, plane, options.sigma_mm);
  auto band = band_at(slabs);
  if (!band) return std::nullopt;
  // The index goes with the surface; the band keeps the points.
  BlendedSurface surface(PatchFitter(band->points, std::move(band->index), band->roughness));
  const auto line = open_line(*band, surface);
  if (!line) return std::nullopt;
  const auto arc = arc_beyond_chord(*line, evidence_reach(*band));
  if (!arc) return std::nullopt;
  const std::vector<SectionLoop> loops = {SectionLoop(closed_straight(*line, kStep * band->grain))};
  const Contour& contour = loops.front().contour;
  if (!contour.goes_round_once()) return std::nullopt;
  const auto evidence = evidence_with_opening(*band, loops.front(), length_of(*line));
  const double beside = unexplained_share(*band, loops, evidence);
  if (beside > kMostBesideLine || evidence.gap > kWidestBridge * contour.length()) {
    return std::nullopt;
  }

  MeasuredSection section = section_by_patches(contour, surface, band->sigma);
  const auto unknowns = unknowns_of(*band, slabs.cloud(), loops, surface, evidence, section);
  widen(*band, unknowns, section);
  auto warnings = warnings_of(*band, loops, evidence, beside, unknowns, section);
  const double unseen = kBeyondArc * *arc + band->grain + missed_by_tape(*line, *band);
  section.contact_u95 += unseen;
  section.stretched_u95 += unseen;
  if (!(section.contact_u95 <= kMostDoubtOfOpening * section.stretched)) return std::nullopt;
  Girth girth = girth_of(*band, section, evidence);
  girth.points = cloud.size();
  girth.largest_gap_mm = band->unit_mm * (line->points.front() - line->points.back()).norm();
  girth.warnings = std::move(warnings);
  girth.warnings.push_back(opening_warning(girth.largest_gap_mm));
  return girth;
}

}  // namespace instep
