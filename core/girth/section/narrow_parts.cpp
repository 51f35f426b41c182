#include "core/girth/section/narrow_parts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/geometry/polygon.h"
#include "core/girth/section/section_evidence.h"

namespace instep {
namespace {

/// In grains. Of even skin no point lies off by half a grain beyond its noise.
constexpr double kOff = 0.5;
constexpr double kFarOff = 4.0;
constexpr double kStretch = 6.0;
constexpr double kOffInDeviations = 5.0;
/// From the plane, in grains: skin that bends is cut elsewhere than it passes a point further off.
constexpr double kNearInGrains = 1.0;
/// Beyond an edge between the plane and a point as near as that skin may run aside by so much of
/// its height.
constexpr double kAsideOfNear = 0.5;
/// Skin that leans more, against upright, does not tell to a grain where it meets the plane.
constexpr double kMostLeaning = 1.5;
/// Of 22 slots and fins that were told wrongly without a word 13 have as many; even skin has one.
constexpr std::size_t kFewest = 4;

bool is_leaning(const OrientedPoint& point) {
  return std::abs(point.normal.z()) > kMostLeaning * point.normal.head<2>().norm();
}

struct PointOff {
  double way;
  double distance;
  Eigen::Vector2d place;
};

std::vector<PointOff> points_off(const PlaneBand& band, const SectionLoop& section) {
  std::vector<PointOff> off;
  for (const auto& point : band.points) {
    const double height = std::abs(point.position.z());
    if (height > kNearInGrains * band.grain || is_leaning(point)) continue;
    const double noise = kOffInDeviations * std::sqrt(point.variance);
    const double least = kOff * band.grain + noise + kAsideOfNear * height;
    if (may_run_to(section.index, point, least)) continue;
    const auto foot = section.index.foot_of(point.position.head<2>());
    if (foot.distance > kFarOff * band.grain) continue;
    off.push_back({foot.way, foot.distance, point.position.head<2>()});
  }
  std::sort(off.begin(), off.end(),
            [](const PointOff& one, const PointOff& other) { return one.way < other.way; });
  return off;
}

/// Those beside the stretch that has the most; a stretch may go over the start of the section.
std::vector<PointOff> crowd_of(const std::vector<PointOff>& off, double stretch, double length) {
  const std::size_t count = off.size();
  std::size_t best = 0;
  std::size_t most = 0;
  std::size_t last = 0;  // the first point beyond the stretch, counted on over the start
  for (std::size_t first = 0; first < count; ++first) {
    const auto way_to = [&](std::size_t i) {
      return off[i % count].way + (i < count ? 0.0 : length) - off[first].way;
    };
    last = std::max(last, first);
    while (last < first + count && way_to(last) <= stretch) ++last;
    if (last - first > most) {
      most = last - first;
      best = first;
    }
  }
  std::vector<PointOff> crowd;
  for (std::size_t i = best; i < best + most; ++i) crowd.push_back(off[i % count]);
  return crowd;
}

}  // namespace

NarrowPart narrow_part_beside(const PlaneBand& band, const SectionLoop& section) {
  NarrowPart part;
  const auto off = points_off(band, section);
  if (off.size() < kFewest) return part;
  const auto crowd = crowd_of(off, kStretch * band.grain, section.index.length());
  if (crowd.size() < kFewest) return part;
  std::vector<Eigen::Vector2d> with_crowd = section.contour.points;
  for (const auto& point : crowd) {
    part.off = std::max(part.off, point.distance);
    with_crowd.push_back(point.place);
  }
  part.contact = 2.0 * (part.off + band.grain);
  const double longer = perimeter(convex_hull(std::move(with_crowd))) -
                        perimeter(convex_hull(section.contour.points));
  if (longer > 0.01 * band.grain) part.stretched = longer + band.grain;
  return part;
}

}  // namespace instep
