#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/surface/noise/noise_estimate.h"
#include "core/surface/oriented_point.h"
#include "core/surface/patches/patch_points.h"
#include "core/surface/patches/surface_patch.h"

namespace instep {

/// Chooses what piece of surface the points round a place make, and fits it: as wide as its
/// neighbours make it, wider where noise asks for it and the surface allows it, over holes and
/// across lines that the points of a smooth surface lie on; with two sheets where the points tell a
/// crease; a field in space where a thin part shows both of its sides. A smooth sheet leaves out
/// strays that lie near the skin (StrayFreeSheet). Read-only: may be used from several threads.
class PatchFitter {
 public:
  /// At least four points, in a unit in which the body is about one long, whose positions `index`
  /// holds. `roughness`: of the surface, see there.
  PatchFitter(std::vector<OrientedPoint> points, PointIndex index,
              std::vector<LocalRoughness> roughness);

  /// Nothing where the points determine no surface. Cost: see the patches.
  std::optional<SurfacePatch> fit(const Eigen::Vector3d& place) const;

  const std::vector<OrientedPoint>& points() const { return points_.all(); }
  const PointIndex& index() const { return points_.index(); }

 private:
  using Neighbours = PatchPoints::Neighbours;
  using Surroundings = PatchPoints::Surroundings;
  using Members = PatchPoints::Members;

  double narrowest_at(const Eigen::Vector3d& place, const Surroundings& here) const;
  std::optional<SurfacePatch> fit_in_space(const Surroundings& surroundings,
                                           const Eigen::Vector3d& place) const;
  std::optional<SurfacePatch> fit_plain(const Surroundings& surroundings,
                                        const Eigen::Vector3d& place) const;
  std::optional<SurfacePatch> plain_patch(const Neighbours& found, double reach,
                                          const Eigen::Vector3d& outward,
                                          const Eigen::Vector3d& place) const;
  std::optional<SurfacePatch> fit_creased(const Surroundings& surroundings,
                                          const Eigen::Vector3d& place, const Members& members,
                                          double roughness) const;
  std::optional<SurfacePatch> fit_creased_nearby(const Surroundings& surroundings,
                                                 const Eigen::Vector3d& place) const;
  std::optional<SurfacePatch> fit_acute(const Surroundings& surroundings,
                                        const Eigen::Vector3d& place) const;
  std::optional<SurfacePatch> fit_sheet(const Surroundings& surroundings,
                                        const Eigen::Vector3d& place, const Members& members,
                                        double roughness) const;
  std::optional<SurfacePatch> fit_finer(const Surroundings& surroundings,
                                        const Eigen::Vector3d& place, const HeightPatch& blurred,
                                        double roughness) const;
  std::optional<SurfacePatch> fit_across_lines(Surroundings surroundings,
                                               const Eigen::Vector3d& place,
                                               double roughness) const;

  PatchPoints points_;
};

}  // namespace instep
