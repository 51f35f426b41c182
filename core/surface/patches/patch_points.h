#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/surface/noise/noise_estimate.h"
#include "core/surface/oriented_point.h"
#include "core/surface/patches/crease_rule.h"

namespace instep {

/// How a patch is made of points.
struct PatchRule {
  std::size_t points;  ///< of a patch: enough to fit a surface, few enough to solve quickly
  std::size_t points_in_space;  ///< of one that shows both sides of a thin part
};

/// The points that patches are made of: what a place knows of those round it, and which of them a
/// patch there takes. Read-only: may be used from several threads.
class PatchPoints {
 public:
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
    bool quiet = false;  ///< little beside the spacing

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

  /// Of the body: wider holes are not spanned.
  static constexpr double kWidestHole = 0.2;

  /// As PatchFitter takes them.
  PatchPoints(std::vector<OrientedPoint> points, PointIndex index,
              std::vector<LocalRoughness> roughness);

  const std::vector<OrientedPoint>& all() const { return points_; }
  const PointIndex& index() const { return index_; }
  const PatchRule& rule() const { return rule_; }
  std::vector<OrientedPoint> at(const std::vector<std::size_t>& indices) const;

  /// O(log points), in a hole more.
  Surroundings surroundings_of(const Eigen::Vector3d& place) const;

  /// Those within `width`, at least the nearest ones; neither strays nor copies of others.
  Members members_of(const Surroundings& surroundings, const Eigen::Vector3d& place,
                     double width) const;

  /// The nearest, on whichever side of a thin part; no copies of others.
  Members all_round(const Surroundings& surroundings) const;

  /// Whether points without told normals show which of two sheets they lie on, even by the crease:
  /// they scatter little and are not strung on lines, of which a few along a round body look like
  /// sheets of a prism. O(points in a patch times the nearest).
  bool are_clear(const Surroundings& surroundings) const;

  /// Whether so many normals lean away from the middle's that they may tell of a crease.
  bool are_bent(const Members& members) const;

  /// `clear`: see there.
  const CreaseRule& crease_rule(bool clear) const;

  /// Of exact points so many are asked first for a crease: the further ones tell no more of it, but
  /// may lie round a second one or on the other side of a thin part.
  std::size_t nearer_points() const;

  /// Of members that come nearest first, as those that reach no further than the nearest do.
  Members nearer_of(const Members& members, const Eigen::Vector3d& place) const;

  /// Whether the points show both sides of a thin part.
  bool is_thin(const Neighbours& nearest) const;

  /// Whether a point can be a height over a patch that looks outwards.
  bool faces(std::size_t point, const Eigen::Vector3d& outward) const;

  /// Leaves out points that nearly repeat another: the slope between the two would be one of
  /// rounding.
  void drop_twins(std::vector<std::size_t>& members, double spacing) const;

 private:
  bool are_strung(const Surroundings& surroundings) const;
  Neighbours nearest_all_round(const Eigen::Vector3d& place) const;
  Eigen::Vector3d outward_of(const Neighbours& nearest) const;
  void drop_strays(Members& members) const;

  std::vector<OrientedPoint> points_;
  PointIndex index_;
  std::vector<LocalRoughness> roughness_;
  bool told_;  ///< all normals
  PatchRule rule_;
};

}  // namespace instep
