#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/surface/noise_estimate.h"
#include "core/surface/oriented_point.h"
#include "core/surface/surface_patch.h"

namespace instep {

/// How a patch is made of points.
struct PatchRule {
  std::size_t points;  ///< of a patch: enough to fit a surface, few enough to solve quickly
  std::size_t points_in_space;  ///< of one that shows both sides of a thin part
  double least_turn;            ///< of a crease, in radians
  double widest_gap;            ///< further from all points, in spacings, its place is a guess
};

/// Chooses what piece of surface the points round a place make, and fits it: as wide as its
/// neighbours make it, wider where noise asks for it and the surface allows it, over holes and
/// across lines that the points of a smooth surface lie on; with two sheets where the points tell a
/// crease; a field in space where a thin part shows both of its sides. Read-only: may be used from
/// several threads.
class PatchFitter {
 public:
  /// At least four points, in a unit in which the body is about one long, whose positions `index`
  /// holds. `roughness`: of the surface, see there.
  PatchFitter(std::vector<OrientedPoint> points, PointIndex index,
              std::vector<LocalRoughness> roughness);

  /// Nothing where the points determine no surface. Cost: see the patches.
  std::optional<SurfacePatch> fit(const Eigen::Vector3d& place) const;

  const std::vector<OrientedPoint>& points() const { return points_; }
  const PointIndex& index() const { return index_; }

 private:
  using Neighbours = std::vector<PointIndex::Neighbour>;

  /// What a place knows of its surroundings before a patch is fitted there.
  struct Surroundings {
    Neighbours nearest;
    double reach = 0.0;       ///< of those
    Eigen::Vector3d outward;  ///< out of the body, here
    double spacing = 0.0;     ///< between points
    double noise_area = 0.0;  ///< variance of a point times the area it has for itself
    double roughness = 0.0;
    bool exact = false;  ///< no noise worth smoothing

    double bandwidth(double of_roughness) const;
  };

  /// The points of a patch.
  struct Members {
    std::vector<std::size_t> all;    ///< but those on the other side of the body
    std::vector<std::size_t> front;  ///< those of them that face as the middle does
    Eigen::Vector3d outward = Eigen::Vector3d::Zero();
    double radius = 0.0;
    double front_radius = 0.0;
  };

  std::size_t nearer_points() const;
  Neighbours nearest_all_round(const Eigen::Vector3d& place) const;
  Eigen::Vector3d outward_of(const Neighbours& nearest) const;
  Surroundings surroundings_of(const Eigen::Vector3d& place) const;
  void drop_strays(Members& members) const;
  void drop_twins(std::vector<std::size_t>& members, double nearest) const;
  Members members_of(const Surroundings& surroundings, const Eigen::Vector3d& place,
                     double width) const;
  Members nearer_of(const Members& members, const Eigen::Vector3d& place) const;
  bool is_thin(const Neighbours& nearest) const;
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
  std::optional<SurfacePatch> fit_sheet(const Surroundings& surroundings,
                                        const Eigen::Vector3d& place, const Members& members,
                                        double roughness) const;
  std::optional<SurfacePatch> fit_across_lines(Surroundings surroundings,
                                               const Eigen::Vector3d& place,
                                               double roughness) const;
  std::vector<OrientedPoint> points_at(const std::vector<std::size_t>& indices) const;

  std::vector<OrientedPoint> points_;
  PointIndex index_;
  std::vector<LocalRoughness> roughness_;
  PatchRule rule_;
};

}  // namespace instep
