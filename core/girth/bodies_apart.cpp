#include "core/girth/bodies_apart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/polygon.h"
#include "core/geometry/voxel_grid.h"
#include "core/girth/plane_slab.h"
#include "core/girth/section_probe.h"

namespace instep {
namespace {

/// Half-widths of the slabs: of the section, as thick as the most noise asks for
/// (smooth_section()), from one to the next, and in spacings.
constexpr double kThickest = 0.22;
constexpr double kThinning = 0.6;
constexpr double kThinnest = 2.0;
/// Sides of the cells that hang together: of the section, from one to the next, in spacings.
constexpr double kWidestSide = 0.1;
constexpr double kNarrowing = 0.7;
constexpr double kNarrowestSide = 1.2;
/// Of the points near the plane, what is a body and no stray.
constexpr double kPartOfAll = 0.02;
/// As many points but for this part are the same body.
constexpr double kAlike = 0.01;

using Bodies = std::vector<BodyApart>;

/// A slab of points, their places in whole steps, which are the same numbers whichever unit the
/// cloud is told in.
struct Slab {
  std::vector<std::size_t> numbers;
  std::vector<Eigen::Vector3d> places;
};

Slab within(const Slab& slab, double half_width) {
  Slab part;
  for (std::size_t i = 0; i < slab.places.size(); ++i) {
    if (std::abs(slab.places[i].z()) > half_width) continue;
    part.numbers.push_back(slab.numbers[i]);
    part.places.push_back(slab.places[i]);
  }
  return part;
}

Slab slab_in_steps(const PointCloud& cloud, const TapePlane& plane, double half_width) {
  PlaneSlab slab = slab_of(cloud, plane, half_width);
  const double step = rounding_step(plane);
  for (auto& place : slab.places) place = (place / step).array().round();
  return {std::move(slab.indices), std::move(slab.places)};
}

/// Those that hang together in cells, the one round the largest area first. `near`: so near to the
/// plane points are at it.
Bodies bodies_in(const Slab& slab, double side, double near) {
  const auto clusters = VoxelGrid(slab.places, side).clusters_of_points();
  Bodies bodies(1 + *std::max_element(clusters.begin(), clusters.end()));
  std::vector<std::vector<Eigen::Vector2d>> sections(bodies.size());
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    bodies[clusters[i]].points.push_back(slab.numbers[i]);
    const Eigen::Vector3d& place = slab.places[i];
    if (std::abs(place.z()) <= near) sections[clusters[i]].emplace_back(place.head<2>());
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (sections[i].size() > 2) bodies[i].area = signed_area(convex_hull(std::move(sections[i])));
    std::sort(bodies[i].points.begin(), bodies[i].points.end());
  }
  const double part = kPartOfAll * static_cast<double>(clusters.size());
  const double few = std::max(part, static_cast<double>(kFewestPoints));
  std::erase_if(bodies, [&](const BodyApart& body) {
    return static_cast<double>(body.points.size()) < few || !(body.area > 0.0);
  });
  std::stable_sort(bodies.begin(), bodies.end(),
                   [](const BodyApart& a, const BodyApart& b) { return a.area > b.area; });
  return bodies;
}

bool are_alike(std::size_t one, std::size_t other) {
  const auto points = static_cast<double>(std::max(one, other));
  return points - static_cast<double>(std::min(one, other)) <= kAlike * points;
}

std::vector<std::size_t> sizes_of(const Bodies& bodies) {
  std::vector<std::size_t> sizes;
  for (const auto& body : bodies) sizes.push_back(body.points.size());
  return sizes;
}

/// Without those that are nearly as one of the sizes.
Bodies unlike(const std::vector<std::size_t>& sizes, Bodies bodies) {
  std::erase_if(bodies, [&](const BodyApart& body) {
    return std::any_of(sizes.begin(), sizes.end(),
                       [&](std::size_t size) { return are_alike(size, body.points.size()); });
  });
  return bodies;
}

/// The ways to take a slab apart, by gaps from wide to narrow: as sides of cells.
std::vector<Bodies> ways_of(const Slab& slab, double widest, double spacing) {
  std::vector<Bodies> ways;
  std::vector<std::size_t> before = {slab.places.size()};
  const double narrowest = kNarrowestSide * spacing;
  if (sizes_of(bodies_in(slab, narrowest, spacing)) == before) return ways;
  for (double side = widest; side > narrowest; side *= kNarrowing) {
    Bodies bodies = bodies_in(slab, std::round(side), spacing);
    auto sizes = sizes_of(bodies);
    bodies = unlike(before, std::move(bodies));
    before = std::move(sizes);
    if (!bodies.empty()) ways.push_back(std::move(bodies));
  }
  return ways;
}

}  // namespace

std::vector<std::vector<BodyApart>> bodies_apart(const PointCloud& cloud, const TapePlane& plane) {
  std::vector<Bodies> all;
  SlabSource slabs(cloud, plane);
  const auto found = probe_section(slabs);
  if (!found) return all;
  const double step = rounding_step(plane);
  const double unit = std::round(found->unit_mm / step);
  const double spacing = std::round(std::max(found->spacing, kFinestGrain) * unit);
  const double thinnest = kThinnest * spacing;
  Slab slab = slab_in_steps(cloud, plane, kThickest * found->unit_mm);
  for (double half_width = kThickest * unit;;
       half_width = std::max(kThinning * half_width, thinnest)) {
    slab = within(slab, half_width);
    if (slab.places.empty()) break;
    for (auto& way : ways_of(slab, kWidestSide * unit, spacing)) all.push_back(std::move(way));
    if (half_width <= thinnest) break;
  }
  for (auto& way : all) {
    for (auto& body : way) body.area *= step * step;
  }
  return all;
}

}  // namespace instep
