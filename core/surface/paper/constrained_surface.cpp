#include "core/surface/paper/constrained_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "core/geometry/principal_frame.h"
#include "core/surface/paper/cylinder_rule.h"
#include "core/surface/paper/marching_cubes.h"

namespace instep {
namespace {

constexpr double kCubesAlongTheLongest = 100.0;
/// What the reconstruction takes of the whole.
constexpr double kReconstructed = 0.5;

/// The cylinder rule for the cubes of a grid. All cubes of a column share a cylinder, which is
/// worked out when one of them first asks.
class AdmittedCubes {
 public:
  AdmittedCubes(const CubeGrid& grid, const CylinderRule& rule) : grid_(grid), rule_(rule) {}

  bool operator()(const Eigen::Vector3i& cube) {
    const Eigen::Vector3d middle = grid_.middle(cube);
    for (const Eigen::Index axis : {2, 0, 1}) {
      const Extent& range = column(axis, cube, middle);
      if (!range.meets(middle[axis] - 0.5 * grid_.cube, middle[axis] + 0.5 * grid_.cube)) {
        return false;
      }
    }
    return true;
  }

 private:
  const Extent& column(Eigen::Index axis, const Eigen::Vector3i& cube,
                       const Eigen::Vector3d& middle) {
    const auto first = static_cast<std::uint64_t>(cube[(axis + 1) % 3]);
    const auto second = static_cast<std::uint64_t>(cube[(axis + 2) % 3]);
    auto& known = columns_[axis];
    const std::uint64_t key = (first << 32U) | second;
    const auto found = known.find(key);
    if (found != known.end()) return found->second;
    return known.emplace(key, rule_.range(axis, middle)).first->second;
  }

  const CubeGrid& grid_;
  const CylinderRule& rule_;
  std::unordered_map<std::uint64_t, Extent> columns_[3];
};

}  // namespace

Result<TriangleMesh> constrained_surface(const std::vector<Eigen::Vector3d>& points,
                                         const ConstrainedSurfaceOptions& options,
                                         const SurfaceProgress& progress) {
  if (points.empty()) {
    return fail(ErrorCode::kInsufficientData, "the cloud has no points", "scan again");
  }
  const RigidTransform principal = principal_from_input(points);
  std::vector<Eigen::Vector3d> turned;
  turned.reserve(points.size());
  Eigen::AlignedBox3d box;
  for (const auto& point : points) {
    turned.emplace_back(principal * point);
    box.extend(turned.back());
  }
  const double longest = box.sizes().maxCoeff();
  if (!(longest > 0.0)) {
    return fail(ErrorCode::kInsufficientData, "all points of the cloud are the same", "scan again");
  }
  const auto grid =
      CubeGrid::covering(box, options.cube_mm.value_or(longest / kCubesAlongTheLongest));
  if (!grid) return tl::make_unexpected(grid.error());
  const auto surface = OctreeSurface::reconstruct(turned, [&](double done) {
    if (progress) progress(kReconstructed * done);
  });
  if (!surface) return tl::make_unexpected(surface.error());

  const CylinderRule rule(surface->points(), surface->longest_edge());
  AdmittedCubes admitted(*grid, rule);
  // A cube that the surface passes may have corners in empty cubes of the octree, or outside it.
  const double reach = 2.0 * std::max(grid->cube, surface->longest_edge());
  TriangleMesh mesh =
      march_cubes(*grid, {[&](const Eigen::Vector3d& place) { return surface->at(place, reach); },
                          [&](const Eigen::Vector3i& cube) { return admitted(cube); },
                          [&](double done) {
                            if (progress) progress(kReconstructed + (1.0 - kReconstructed) * done);
                          }});
  if (mesh.empty()) {
    return fail(ErrorCode::kInsufficientData, "no surface could be found between the points",
                "give a denser cloud, or smaller cubes");
  }
  const RigidTransform input = principal.inverse();
  for (auto& position : mesh.positions) position = input * position;
  return mesh;
}

}  // namespace instep
