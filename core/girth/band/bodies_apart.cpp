#include "core/girth/band/bodies_apart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/polygon.h"
#include "core/geometry/voxel_grid.h"
#include "core/girth/band/plane_slab.h"
#include "core/girth/band/section_probe.h"

namespace instep {
namespace {

/// Half-widths of the slabs: of the section, as thick as the most noise asks for
/// (smooth_section()), from one to the next, and in spacings. Of 320 bodies above a floor 304
/// girths hold, and 284 with none thinner than a band of exact points, 6.5 spacings.
constexpr double kThickest = 0.22;
constexpr double kThinning = 0.6;
constexpr double kThinnest = 2.0;
/// Sides of the cells that hang together: of the section, from one to the next, in spacings.
constexpr double kWidestSide = 0.1;
constexpr double kNarrowing = 0.7;
constexpr double kNarrowestSide = 1.2;
/// Of the points near the plane, what is a body and no stray.
constexpr double kPartOfAll = 0.02;
/// Of their points, that bodies which are the same need not share.
constexpr double kAlike = 0.01;
/// Points that are looked at in all: against those of the thickest slab, and some more, which are
/// soon done. Of 1,744 girths beside walls, floors and strays no more hold with four times as many.
constexpr std::size_t kMostWork = 2;
constexpr std::size_t kAnyWork = 50000;

using Bodies = std::vector<BodyApart>;

/// Those that hang together in cells, the one round the largest area first. `near`: so near to the
/// plane points are at it.
Bodies bodies_in(const PlaneSlab& slab, double side, double near) {
  const auto clusters = VoxelGrid(slab.places, side).clusters_of_points();
  Bodies bodies(1 + *std::max_element(clusters.begin(), clusters.end()));
  std::vector<std::vector<Eigen::Vector2d>> sections(bodies.size());
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    bodies[clusters[i]].points.push_back(slab.indices[i]);
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

/// Whether all points but few are of both.
bool are_alike(const BodyApart& one, const BodyApart& other) {
  const std::size_t larger = std::max(one.points.size(), other.points.size());
  return static_cast<double>(shared_points(one.points, other.points)) >=
         (1.0 - kAlike) * static_cast<double>(larger);
}

/// Whether all of a slab hangs together, whatever the gaps.
bool is_one_body(const PlaneSlab& slab, double narrowest, double spacing) {
  const Bodies bodies = bodies_in(slab, narrowest, spacing);
  return bodies.size() == 1 && bodies.front().points.size() == slab.places.size();
}

/// Shows what is new in each way, while as many points may be looked at.
class Showing {
 public:
  Showing(BodiesLook& look, std::size_t most_points, double step)
      : look_(look), left_(most_points), step_(step) {}

  /// By gaps from wide to narrow: as sides of cells.
  void show(const PlaneSlab& slab, double widest, double spacing) {
    const double narrowest = kNarrowestSide * spacing;
    if (is_one_body(slab, narrowest, spacing)) return;
    seen_ = {{slab.indices, 0.0}};
    std::sort(seen_.front().points.begin(), seen_.front().points.end());
    for (double side = widest; side > narrowest; side *= kNarrowing) {
      show_way(bodies_in(slab, std::round(side), spacing));
    }
  }

 private:
  bool is_seen(const BodyApart& body) const {
    return std::any_of(seen_.begin(), seen_.end(),
                       [&](const BodyApart& other) { return are_alike(body, other); });
  }

  void show_way(Bodies bodies) {
    for (auto& body : bodies) {
      body.area *= step_ * step_;
      if (!look_.may_count(body)) return;
      if (is_seen(body)) continue;
      if (body.points.size() > left_) return look_.pass_over(body);
      left_ -= body.points.size();
      const bool goes_on = look_.look_at(body);
      seen_.push_back(std::move(body));
      if (!goes_on) return;
    }
  }

  BodiesLook& look_;
  std::size_t left_;
  double step_;
  Bodies seen_;  ///< of a slab, and all of it
};

}  // namespace

std::size_t shared_points(const std::vector<std::size_t>& one,
                          const std::vector<std::size_t>& other) {
  std::size_t shared = 0;
  auto at = other.begin();
  for (const std::size_t point : one) {
    while (at != other.end() && *at < point) ++at;
    if (at != other.end() && *at == point) ++shared;
  }
  return shared;
}

void look_at_bodies_apart(const PointCloud& cloud, const TapePlane& plane, BodiesLook& look) {
  if (cloud.size() < kFewestPoints) return;
  SlabSource slabs(cloud, plane);
  const auto found = probe_section(slabs);
  if (!found) return;
  const double step = rounding_step(plane);
  const double unit = std::round(found->unit_mm / step);
  const double spacing = std::round(std::max(found->spacing, kFinestGrain) * unit);
  const double thinnest = kThinnest * spacing;
  // Not that of a SlabSource, which may have thinned lines for good.
  PlaneSlab slab = slab_of(cloud, plane, kThickest * found->unit_mm);
  slab.places = in_steps(std::move(slab.places), step);
  Showing showing(look, kMostWork * slab.places.size() + kAnyWork, step);
  std::size_t thicker = 0;  // points of the slab before
  for (double half_width = kThickest * unit; !look.is_settled();
       half_width = std::max(kThinning * half_width, thinnest)) {
    slab = within(slab, half_width);
    if (slab.places.empty()) return;
    if (slab.places.size() != thicker) showing.show(slab, kWidestSide * unit, spacing);
    thicker = slab.places.size();
    if (half_width <= thinnest) return;
  }
}

}  // namespace instep
