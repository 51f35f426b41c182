#include "core/surface/paper/octree_surface.h"

#include <cstdint>
#include <utility>

#include "core/geometry/distinct_points.h"
#include "core/geometry/near_copies.h"
#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/geometry/spanning_tree.h"
#include "core/picked.h"
#include "core/surface/paper/box_normals.h"
#include "core/surface/paper/off_surface_points.h"

namespace instep {
namespace {

/// Distance of off-surface points, against the shortest edge of the spanning tree.
constexpr double kOffSurface = 0.1;
/// Points that are nearer to each other, against the spacing, are one: a pair that nearly coincides
/// would set the shortest edge, and with it the distance of off-surface points, to nothing, and no
/// solver separates the two then.
constexpr double kCopy = 1e-3;
/// Points from which a leaf is reconstructed; the paper's n_min.
constexpr std::size_t kFewest = 10;
/// Most points, off-surface points included, in a leaf; the paper's n_max.
constexpr std::size_t kMost = 300;
/// What the preparation takes of the whole.
constexpr double kPrepared = 0.3;

tl::unexpected<Error> no_surface() {
  return fail(ErrorCode::kInsufficientData,
              "the points determine no surface: they are too few, or lie on lines",
              "scan again, or give a denser cloud");
}

}  // namespace

Result<OctreeSurface> OctreeSurface::reconstruct(const std::vector<Eigen::Vector3d>& input,
                                                 const SurfaceProgress& progress) {
  const auto report = [&](double done) {
    if (progress) progress(done);
  };
  report(0.0);
  std::vector<Eigen::Vector3d> distinct;
  for (const std::size_t i : distinct_points(input)) distinct.push_back(input[i]);
  if (distinct.size() < 2) return no_surface();
  const double spacing = median_nearest_distance(PointIndex(distinct));
  const auto copies = near_copies(distinct, kCopy * spacing);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    if (!copies[i]) points.push_back(distinct[i]);
  }
  if (2 * points.size() < kFewest) return no_surface();
  const auto tree = minimum_spanning_tree(points);
  report(0.5 * kPrepared);
  const double shortest = tree.front().length;
  const auto samples = with_off_surface_points(points, box_normals(points), kOffSurface * shortest);
  if (!has_unique_solution(samples.positions)) return no_surface();
  Octree octree(samples.positions, kMost);
  const auto groups =
      combined_points(octree, kMost, [&](const std::vector<std::uint32_t>& members) {
        return members.size() >= kFewest && has_unique_solution(picked(samples.positions, members));
      });
  report(kPrepared);

  OctreeSurface surface(std::move(points), std::move(octree));
  surface.longest_edge_ = tree.back().length;
  std::size_t solved = 0;
  for (const auto& members : groups) {
    surface.fields_.push_back(TriharmonicRbf::fit(picked(samples.positions, members),
                                                  picked(samples.values, members),
                                                  std::vector<double>(members.size(), 0.0)));
    if (surface.fields_.back()) ++solved;
    report(kPrepared + (1.0 - kPrepared) * static_cast<double>(surface.fields_.size()) /
                           static_cast<double>(groups.size()));
  }
  if (solved == 0) return no_surface();
  return surface;
}

std::optional<std::size_t> OctreeSurface::leaf_at(const Eigen::Vector3d& place) const {
  const auto leaf = octree_.leaf_at(place);
  return leaf && fields_[*leaf] ? leaf : std::nullopt;
}

std::optional<double> OctreeSurface::at(const Eigen::Vector3d& place, double reach) const {
  auto leaf = octree_.leaf_at(place);
  if (!leaf) leaf = octree_.nearest_leaf(place, reach);
  if (!leaf || !fields_[*leaf]) return std::nullopt;
  return value_of_leaf(*leaf, place);
}

}  // namespace instep
