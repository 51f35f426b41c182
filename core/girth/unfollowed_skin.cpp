#include "core/girth/unfollowed_skin.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/geometry/point_index.h"
#include "core/geometry/polygon.h"
#include "core/girth/section_evidence.h"

namespace instep {
namespace {

/// Skin lies no further from the loop that follows it: in grains, and in deviations of the noise.
constexpr double kOffInGrains = 0.7;
constexpr double kOffInDeviations = 5.0;
/// Beyond an edge between the plane and a point skin may run aside by so much of its height.
constexpr double kAsideBeyondEdge = 2.0;
/// Skin that leans more, against upright, does not tell where it meets the plane.
constexpr double kMostLean = 2.5;
/// Points beside the section may be sparser than a grain, up to this, in grains.
constexpr double kSparsest = 4.0;
/// How far from a point its spacing reaches: as many others.
constexpr std::size_t kNeighbours = 6;
/// In spacings: from the plane; to the next point of one skin, and to the section.
constexpr double kClose = 0.4;
constexpr double kStep = 2.5;
/// Fewer points that hang together may be strays.
constexpr std::size_t kFewest = 8;

/// A point beside the section.
struct Beside {
  Eigen::Vector3d position;
  double off = 0.0;       ///< from the section
  bool followed = false;  ///< by another loop
  double spacing = 0.0;   ///< of those round it
};

bool may_lie_on(const ContourIndex& contour, const OrientedPoint& point, double grain) {
  const double noise = kOffInDeviations * std::sqrt(point.variance);
  const double aside = kAsideBeyondEdge * std::abs(point.position.z());
  return may_run_to(contour, point, kOffInGrains * grain + noise + aside);
}

std::vector<Beside> off_the_section(const PlaneBand& band,
                                    const std::vector<const ContourIndex*>& loops) {
  std::vector<Beside> beside;
  for (const auto& point : band.points) {
    if (std::abs(point.normal.z()) > kMostLean * point.normal.head<2>().norm()) continue;
    if (may_lie_on(*loops.front(), point, band.grain)) continue;
    const bool followed = std::any_of(
        loops.begin() + 1, loops.end(),
        [&](const ContourIndex* other) { return may_lie_on(*other, point, band.grain); });
    const double off = loops.front()->foot_of(point.position.head<2>()).distance;
    beside.push_back({point.position, off, followed});
  }
  return beside;
}

PointIndex index_of(const std::vector<Beside>& points) {
  std::vector<Eigen::Vector3d> positions;
  for (const auto& point : points) positions.push_back(point.position);
  return PointIndex(std::move(positions));
}

/// Those of the points that lie close to the plane, with their spacings.
std::vector<Beside> close_to_plane(std::vector<Beside> points, double grain) {
  const PointIndex index = index_of(points);
  for (auto& point : points) {
    const auto nearest = index.nearest(point.position, kNeighbours + 1);
    const double reach = std::sqrt(nearest.back().squared_distance);
    point.spacing = std::clamp(reach, grain, kSparsest * grain);
  }
  std::erase_if(points, [](const Beside& point) {
    return std::abs(point.position.z()) > kClose * point.spacing;
  });
  return points;
}

/// All that chains of neighbours join to one that was not found before, which comes first.
std::vector<std::size_t> chained_to(std::size_t first, const std::vector<Beside>& points,
                                    const PointIndex& index, std::vector<bool>& found) {
  std::vector<std::size_t> chained = {first};
  found[first] = true;
  for (std::size_t next = 0; next < chained.size(); ++next) {
    const Beside& here = points[chained[next]];
    for (const auto& neighbour : index.around(here.position, kStep * here.spacing)) {
      if (found[neighbour.index]) continue;
      found[neighbour.index] = true;
      chained.push_back(neighbour.index);
    }
  }
  return chained;
}

/// The points on skin that begins at the section.
std::vector<Beside> hanging_together(const std::vector<Beside>& points) {
  const PointIndex index = index_of(points);
  std::vector<bool> found(points.size(), false);
  std::vector<Beside> hanging;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (found[i] || points[i].followed || points[i].off > kStep * points[i].spacing) continue;
    const auto chained = chained_to(i, points, index, found);
    if (chained.size() < kFewest) continue;
    for (const std::size_t member : chained) hanging.push_back(points[member]);
  }
  return hanging;
}

}  // namespace

UnfollowedSkin unfollowed_skin(const PlaneBand& band, const Contour& section,
                               const std::vector<const ContourIndex*>& loops) {
  auto beside = off_the_section(band, loops);
  if (beside.size() < kFewest) return {};
  const auto hanging = hanging_together(close_to_plane(std::move(beside), band.grain));
  if (hanging.empty()) return {};
  UnfollowedSkin skin;
  double seen = 0.0;
  std::vector<Eigen::Vector2d> with_skin = section.points;
  for (const auto& point : hanging) {
    seen = std::max(seen, point.off);
    skin.off = std::max(skin.off, point.off + 0.5 * point.spacing);
    with_skin.emplace_back(point.position.head<2>());
  }
  const double longer =
      perimeter(convex_hull(std::move(with_skin))) - perimeter(convex_hull(section.points));
  skin.contact = 2.0 * skin.off;
  skin.stretched = skin.off / seen * longer;
  return skin;
}

}  // namespace instep
