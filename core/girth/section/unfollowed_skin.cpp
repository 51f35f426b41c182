#include "core/girth/section/unfollowed_skin.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/geometry/point_index.h"
#include "core/geometry/polygon.h"
#include "core/girth/section/section_evidence.h"

namespace instep {
namespace {

/// Skin lies no further from the loop that follows it: in grains, and in deviations of the noise.
constexpr double kOffInGrains = 0.7;
constexpr double kOffInDeviations = 5.0;
/// Beyond an edge between the plane and a point at any height in the band skin may run aside by so
/// much of that.
constexpr double kAsideInBand = 2.0;
/// Skin that leans more, against upright, does not even tell which section it belongs to.
constexpr double kLyingFlat = 2.5;
/// Skin that hangs together with the section begins this near to it beyond the noise, in grains,
/// or, where its points are sparser than the section's, in their reaches.
constexpr double kBegins = 1.5;
constexpr double kSparseBegins = 1.25;
/// So many neighbours lie within the reach of a point on it; of strays, which fill the air, they
/// lie further off than this, in grains.
constexpr std::size_t kNeighbours = 6;
constexpr double kWidestReach = 4.0;
/// In reaches: from the plane, and from one point of a skin to the next.
constexpr double kClose = 0.4;
constexpr double kStep = 2.5;
/// Fewer points that hang together may be strays.
constexpr std::size_t kFewest = 8;

/// A point beside the section.
struct Beside {
  Eigen::Vector3d position;
  double off = 0.0;       ///< from the section
  double noise = 0.0;     ///< may have moved it by so much
  bool followed = false;  ///< by another loop
  double reach = 0.0;     ///< to its neighbours, a grain at least
};

double most_noise_of(const OrientedPoint& point) {
  return kOffInDeviations * std::sqrt(point.variance);
}

bool may_lie_on(const ContourIndex& contour, const OrientedPoint& point, double grain) {
  const double aside = kAsideInBand * std::abs(point.position.z());
  return may_run_to(contour, point, kOffInGrains * grain + most_noise_of(point) + aside);
}

std::vector<Beside> off_the_section(const PlaneBand& band, const std::vector<SectionLoop>& loops) {
  const ContourIndex& section = loops.front().index;
  std::vector<Beside> beside;
  for (const auto& point : band.points) {
    if (std::abs(point.normal.z()) > kLyingFlat * point.normal.head<2>().norm()) continue;
    if (may_lie_on(section, point, band.grain)) continue;
    const bool followed = std::any_of(
        loops.begin() + 1, loops.end(),
        [&](const SectionLoop& other) { return may_lie_on(other.index, point, band.grain); });
    const double off = section.foot_of(point.position.head<2>()).distance;
    beside.push_back({point.position, off, most_noise_of(point), followed});
  }
  return beside;
}

PointIndex index_of(const std::vector<Beside>& points) {
  std::vector<Eigen::Vector3d> positions;
  for (const auto& point : points) positions.push_back(point.position);
  return PointIndex(std::move(positions));
}

/// Those of the points that lie close to the plane and have neighbours.
std::vector<Beside> close_to_plane(std::vector<Beside> points, double grain) {
  const PointIndex index = index_of(points);
  for (auto& point : points) {
    const auto nearest = index.nearest(point.position, kNeighbours + 1);
    point.reach = std::max(std::sqrt(nearest.back().squared_distance), grain);
  }
  std::erase_if(points, [&](const Beside& point) {
    return point.reach > kWidestReach * grain ||
           std::abs(point.position.z()) > kClose * point.reach;
  });
  return points;
}

/// All that chains of neighbours join to one that was not found before.
std::vector<Beside> chained_to(std::size_t first, const std::vector<Beside>& points,
                               const PointIndex& index, std::vector<bool>& found) {
  std::vector<Beside> chained = {points[first]};
  found[first] = true;
  for (std::size_t next = 0; next < chained.size(); ++next) {
    const Beside here = chained[next];
    for (const auto& neighbour : index.around(here.position, kStep * here.reach)) {
      const Beside& other = points[neighbour.index];
      const bool near = neighbour.squared_distance <= std::pow(kStep * other.reach, 2);
      if (!near || found[neighbour.index]) continue;
      found[neighbour.index] = true;
      chained.push_back(other);
    }
  }
  return chained;
}

/// Whether a chain is skin that begins at the section.
bool begins_at_section(const std::vector<Beside>& chained, double grain) {
  return chained.size() >= kFewest &&
         std::any_of(chained.begin(), chained.end(), [&](const Beside& point) {
           return !point.followed &&
                  point.off - point.noise <= std::max(kBegins * grain, kSparseBegins * point.reach);
         });
}

/// From where a chain is nearest to the section to its far end, which lies beyond its last point.
double extent_of(const std::vector<Beside>& chained) {
  const auto root =
      std::min_element(chained.begin(), chained.end(),
                       [](const Beside& a, const Beside& b) { return a.off < b.off; });
  double extent = 0.0;
  for (const auto& point : chained) {
    extent = std::max(extent, (point.position - root->position).norm() + 0.5 * point.reach);
  }
  return root->off + extent;
}

}  // namespace

UnfollowedSkin unfollowed_skin(const PlaneBand& band, const std::vector<SectionLoop>& loops) {
  auto beside = off_the_section(band, loops);
  UnfollowedSkin skin{.points = beside.size()};
  if (beside.size() < kFewest) return skin;
  beside = close_to_plane(std::move(beside), band.grain);
  const PointIndex index = index_of(beside);

  double widest_reach = 0.0;
  const auto& section = loops.front().contour.points;
  std::vector<Eigen::Vector2d> with_skin = section;
  std::vector<bool> found(beside.size(), false);
  for (std::size_t i = 0; i < beside.size(); ++i) {
    if (found[i]) continue;
    const auto chained = chained_to(i, beside, index, found);
    if (!begins_at_section(chained, band.grain)) continue;
    skin.contact += 2.0 * extent_of(chained);
    for (const auto& point : chained) {
      skin.off = std::max(skin.off, point.off);
      widest_reach = std::max(widest_reach, point.reach);
      with_skin.emplace_back(point.position.head<2>());
    }
  }
  const double longer =
      perimeter(convex_hull(std::move(with_skin))) - perimeter(convex_hull(section));
  // Half a reach beyond the last point, there and back again.
  if (longer > 0.0) skin.stretched = longer + widest_reach;
  return skin;
}

}  // namespace instep
