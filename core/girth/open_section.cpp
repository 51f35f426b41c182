#include "core/girth/open_section.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/plane_vectors.h"
#include "core/geometry/polygon.h"
#include "core/girth/contour_trace.h"
#include "core/girth/length_doubt.h"
#include "core/girth/plane_band.h"
#include "core/girth/section_evidence.h"
#include "core/girth/section_gaps.h"
#include "core/girth/section_loops.h"
#include "core/girth/section_unknowns.h"
#include "core/girth/section_warnings.h"
#include "core/girth/told_girth.h"
#include "core/in_millimetres.h"
#include "core/surface/blended_surface.h"

namespace instep {
namespace {

/// An opening, against the hull of the points: of less patches span more.
constexpr double kLeastOpening = 0.1;
/// Steps in grains, as a closed section is traced.
constexpr double kStep = 0.5;
/// A line along the skin, against the width of the body.
constexpr double kLongestLine = 6.0;
constexpr std::size_t kFewestCorners = 8;
/// Within so many grains of the plane and the line points tell where the skin ends: further off the
/// rim of an opening has turned up or down.
constexpr double kAtPlane = 1.0;
/// Of the points near the plane, off the line.
constexpr double kMostBesideLine = 0.1;
/// What may lie in an opening, against what an arc adds there. Of 62 ellipses, rounded boxes and
/// bodies between of which 20 to 40 % of the way round were missing 54 held, all ellipses among
/// them; with 1.2 15 of 24.
constexpr double kBeyondArc = 2.0;
/// Half of a 95 % interval that leaves nothing to be told, against the length. More than of closed
/// sections: the length along what was seen is sure.
constexpr double kMostDoubtOfOpening = 0.15;
/// Half of what skin turns in an opening (radians) beyond which no arc tells anything.
constexpr double kMostHalfTurn = 0.8 * std::numbers::pi;

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

/// The mean direction out of the body within `near` of an end of the line, where skin was seen on
/// one side only.
Eigen::Vector2d outward_near(const Contour& line, const Eigen::Vector2d& end, double near) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    if ((line.points[i] - end).norm() <= near) sum += line.outward[i];
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
/// than a tape across it; infinitely much where the skin turns away from the opening.
double arc_beyond_chord(const Contour& line, double near) {
  const Opening opening = left_by_tape(line);
  const Eigen::Vector2d across = opening.to - opening.from;
  const Eigen::Vector2d outward(across.y(), -across.x());
  const double half = 0.5 * (turn_between(outward_near(line, opening.from, near), outward) +
                             turn_between(outward, outward_near(line, opening.to, near)));
  if (!(half > 0.0)) return 0.0;
  if (half > kMostHalfTurn) return std::numeric_limits<double>::infinity();
  return across.norm() * (half / std::sin(half) - 1.0);
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

/// From the first to the last of the points along it: what was followed beyond is no skin that was
/// seen. No corner is left where there are none.
Contour seen_part(const Contour& line, const PlaneBand& band) {
  const ContourIndex closed(closed_straight(line, kStep * band.grain));
  const auto ways = evidence_for(band, closed, kAtPlane * band.grain).ways;
  const auto after = std::upper_bound(ways.begin(), ways.end(), length_of(line));
  Contour seen;
  if (after == ways.begin()) return seen;
  double way = 0.0;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    if (way >= ways.front() && way <= *std::prev(after)) {
      seen.points.push_back(line.points[i]);
      seen.outward.push_back(line.outward[i]);
    }
    way += line.chord(i);
  }
  return seen;
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

/// By what is known of the skin beside the opening.
MeasuredSection measured(const Contour& contour, const BlendedSurface& surface, double sigma) {
  const LengthDoubt doubt = doubt_of(contour, surface, sigma);
  return {contour,
          contour.length() + doubt.waves,
          contour.tape_length() + doubt.waves,
          doubt.contact_u95,
          doubt.stretched_u95,
          {}};
}

std::string opening_warning(double width_mm) {
  return "the section is open over " + in_millimetres(width_mm) +
         ": the tape is laid straight across, and is longer if the body bulges there, which the "
         "interval reaches; scan the body from there too";
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
  const std::vector<SectionLoop> loops = {SectionLoop(closed_straight(*line, kStep * band->grain))};
  const Contour& contour = loops.front().contour;
  if (!contour.goes_round_once()) return std::nullopt;
  const auto evidence = evidence_with_opening(*band, loops.front(), length_of(*line));
  const double beside = unexplained_share(*band, loops, evidence);
  if (beside > kMostBesideLine || evidence.gap > kWidestBridge * contour.length()) {
    return std::nullopt;
  }

  MeasuredSection section = measured(contour, surface, band->sigma);
  const auto unknowns = unknowns_of(*band, slabs.cloud(), loops, surface, evidence, section);
  widen(*band, unknowns, section);
  auto warnings = warnings_of(*band, loops, evidence, beside, unknowns, section);
  const double unseen = kBeyondArc * arc_beyond_chord(*line, evidence_reach(*band)) + band->grain;
  section.contact_u95 += unseen;
  section.stretched_u95 += unseen;
  if (!(section.stretched_u95 <= kMostDoubtOfOpening * section.stretched)) return std::nullopt;
  Girth girth = girth_of(*band, section, evidence);
  girth.points = cloud.size();
  girth.largest_gap_mm = band->unit_mm * (line->points.front() - line->points.back()).norm();
  girth.warnings = std::move(warnings);
  girth.warnings.push_back(opening_warning(girth.largest_gap_mm));
  return girth;
}

}  // namespace instep
