#include "core/girth/section/smooth_section.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/geometry/near_copies.h"
#include "core/geometry/plane_vectors.h"
#include "core/girth/contour/contour_turns.h"
#include "core/girth/contour/fair_line.h"
#include "core/girth/doubt/length_doubt.h"
#include "core/girth/section/finer_skin.h"
#include "core/normal_spread.h"
#include "core/surface/ribbon/ribbon_spline.h"

namespace instep {
namespace {

/// All against the section.
constexpr double kLeastNoise = 1e-4;
constexpr double kHalfWidth = 0.2;
constexpr double kFairKnotsApart = 0.12;
constexpr double kKnotsApart = 0.06;
/// Points further from the line are of something else: so far off on the plane, and more by as much
/// as skin leans.
constexpr double kReach = 0.03;
constexpr double kReachInSigmas = 3.0;
constexpr double kLean = 0.8;
/// A denser ribbon is narrower: what noise leaves depends on their number alone. But over a hole
/// skin is told by what lies to both sides of it along the body: there no ribbon is.
constexpr double kMostPoints = 20000.0;
/// Even skin: what it bends from knot to knot, its scatter against that of the band, and by how
/// much (radians) it turns more between two knots than beside them. Over drawn shapes, feet and
/// lasts (tests/bench/accuracy) intervals of even sections hold as they should; of sections beyond
/// these limits, sorted by both, those of most sorts hold in 36 to 75 %.
constexpr double kMostBending = 0.005;
constexpr double kMostScatter = 1.15;
constexpr double kSharpestTurn = 0.15;
/// From so many points of a band on the line is asked first, which costs a twentieth. A fold of
/// patches may bend it more than the skin, so that its turns tell less.
constexpr std::size_t kManyPoints = 3000;
constexpr double kSharpestTurnOfLine = 0.2;

constexpr double kLeast = 8e-5;

double half_width_of(const PlaneBand& band) {
  double reach = 0.0;
  for (const auto& point : band.points) reach = std::max(reach, std::abs(point.position.z()));
  return std::min(kHalfWidth, reach * kMostPoints / static_cast<double>(band.points.size()));
}

std::vector<RibbonPoint> ribbon_of(SlabSource& slabs, const PlaneBand& band, const FairLine& line,
                                   bool is_bridged) {
  const PointCloud& cloud = slabs.cloud();
  const double half_width = is_bridged ? kHalfWidth : half_width_of(band);
  PlaneSlab slab = slabs.slab(half_width * band.unit_mm);
  if (band.copies_within > 0.0) {
    slab = without(near_copies(slab.places, band.copies_within * band.unit_mm), slab);
  }
  std::vector<RibbonPoint> ribbon;
  ribbon.reserve(slab.places.size());
  for (std::size_t i = 0; i < slab.places.size(); ++i) {
    const Eigen::Vector2d place = (slab.places[i].head<2>() - band.middle_mm) / band.unit_mm;
    const double off = slab.places[i].z() / band.unit_mm;
    const auto foot = line.foot_of(place);
    const double reach = kReach + kReachInSigmas * band.sigma + kLean * std::abs(off);
    if (!(foot.distance <= reach)) continue;
    const double sigma = band.sigma_of(cloud, slab.indices[i], slab.share_of(i), slab.error_of(i),
                                       {place.x(), place.y(), off}) /
                         band.sigma;
    ribbon.push_back({foot.way, off / half_width, foot.height, 1.0 / (sigma * sigma)});
  }
  return ribbon;
}

/// Out of the body, of unit length, where the heights lean over the line.
Eigen::Vector2d outward_at(const FairLine& line, const RibbonSpline& ribbon, double way) {
  const auto place = line.at(way);
  const double slope = ribbon.at(way).slope / place.tangent.squaredNorm();
  return (place.outward - slope * place.tangent).normalized();
}

/// By how much directions out of the body, evenly round it, turn more between two than beside them,
/// at most: noise blunts a crease, but does not hide it.
double sharpest_turn(const std::vector<Eigen::Vector2d>& outward) {
  const std::size_t count = outward.size();
  std::vector<double> turns;
  for (std::size_t i = 0; i < count; ++i) {
    turns.push_back(turn_between(outward[i], outward[(i + 1) % count]));
  }
  double sharpest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double beside = 0.5 * (turns[(i + 1) % count] + turns[(i + count - 1) % count]);
    sharpest = std::max(sharpest, std::abs(turns[i] - beside));
  }
  return sharpest;
}

/// As many ways along the line, evenly.
std::vector<double> ways_along(const FairLine& line, std::size_t count) {
  std::vector<double> ways;
  for (std::size_t i = 0; i < count; ++i) {
    ways.push_back(line.length() * static_cast<double>(i) / static_cast<double>(count));
  }
  return ways;
}

double sharpest_turn(const FairLine& line, const std::vector<double>& ways) {
  std::vector<Eigen::Vector2d> outward;
  for (const double way : ways) outward.push_back(line.at(way).outward);
  return sharpest_turn(outward);
}

double sharpest_turn(const FairLine& line, const RibbonSpline& ribbon,
                     const std::vector<double>& ways) {
  std::vector<Eigen::Vector2d> outward;
  for (const double way : ways) outward.push_back(outward_at(line, ribbon, way));
  return sharpest_turn(outward);
}

bool is_even(const FairLine& line, const RibbonSpline& ribbon, const std::vector<double>& knots,
             double noise) {
  return ribbon.bending() <= kMostBending && ribbon.sigma() <= kMostScatter * noise &&
         sharpest_turn(line, ribbon, knots) <= kSharpestTurn;
}

/// As many corners as the contour had.
Contour moved(const FairLine& line, const RibbonSpline& ribbon, const std::vector<double>& ways) {
  Contour contour;
  for (const double way : ways) {
    const auto place = line.at(way);
    contour.points.emplace_back(place.point + ribbon.at(way).value * place.outward);
    contour.outward.push_back(outward_at(line, ribbon, way));
  }
  return contour;
}

/// `sigma`: of the points.
double u95_of(const RibbonSpline& ribbon, const std::vector<double>& ways,
              const std::vector<double>& turns, const MeasuredSection& section, double sigma) {
  const double seen = kDeviations * std::sqrt(ribbon.variance_of_sum(ways, turns));
  return std::hypot(seen + kLeast * section.contact, doubt_of_direction(sigma, section.contour));
}

}  // namespace

std::optional<MeasuredSection> smooth_section(SlabSource& slabs, const PlaneBand& band,
                                              const Contour& contour, bool is_bridged) {
  if (!(band.sigma > kLeastNoise)) return std::nullopt;
  const auto line = FairLine::through(contour, kFairKnotsApart);
  if (!line) return std::nullopt;
  const auto knots =
      ways_along(*line, static_cast<std::size_t>(std::lround(line->length() / kKnotsApart)));
  const bool asks_line = band.points.size() >= kManyPoints;
  if (asks_line && sharpest_turn(*line, knots) > kSharpestTurnOfLine) return std::nullopt;
  const auto points = ribbon_of(slabs, band, *line, is_bridged);
  const auto ribbon = RibbonSpline::through(points, line->length(), static_cast<int>(knots.size()));
  if (!ribbon || !is_even(*line, *ribbon, knots, band.sigma)) return std::nullopt;

  const auto ways = ways_along(*line, contour.points.size());
  MeasuredSection section;
  section.contour = moved(*line, *ribbon, ways);
  section.contact = section.contour.length();
  section.stretched = section.contour.tape_length();
  const auto turns = turns_of(section.contour);
  section.contact_u95 = u95_of(*ribbon, ways, turns.contact, section, band.sigma);
  section.stretched_u95 = u95_of(*ribbon, ways, turns.stretched, section, band.sigma);
  const auto finer = finer_skin_over(*ribbon, points, line->length());
  if (finer && !may_be_rounding(*finer, band.unit_mm, slabs.cloud())) {
    section.missed = missed_length(*finer, section.contact);
  }
  return section;
}

}  // namespace instep
