#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/surface/oriented_point.h"
#include "core/surface/patches/height_patch.h"

namespace instep {

/// Two height patches that meet in a crease, such as the featherline of a last: the body is what
/// lies under both (a convex crease) or under either. A single smooth patch would ring there or
/// cut the edge off. After the sharp features of multi-level partition of unity implicits (Ohtake
/// and others 2003), with the points told apart by the patches themselves, or by their told
/// normals.
class CreasedPatch {
 public:
  /// As for HeightPatch. `clear`: the points scatter so little that even those by the crease show
  /// which sheet they lie on, and how it bends there (TwoSheets::part_by_quadratics). Nothing if
  /// the points do not fall into two sheets of at least six that meet in an angle, if quadratics
  /// through the two plainly meet in none, as where one smooth surface was cut in two, if clear
  /// points lie on rows along the crease that leave it open, or if each would have to be cut off by
  /// the other where points of it lie. Two fits and some passes over the points, with at most 28
  /// quadratics of them.
  static std::optional<CreasedPatch> fit(const std::vector<OrientedPoint>& points,
                                         const Eigen::Vector3d& centre, double radius,
                                         double roughness, bool clear);

  FieldValue at(const Eigen::Vector3d& position) const;

  /// A sheet and the points it was fitted to, by their places in the list given to fit().
  struct Sheet {
    HeightPatch patch;
    std::vector<std::size_t> members;
  };
  /// The sheet that bounds the body there.
  const Sheet& sheet_at(const Eigen::Vector3d& position) const;

  /// Angle between the two sheets' normals where they meet, in radians.
  double turn() const { return turn_; }

  /// By how much more the planes through the two sheets turn than that, in radians: sheets that
  /// bend towards the crease may go on to bend there. Less than nothing where they bend away from
  /// it.
  double bend() const { return bend_; }

  /// Distance from the place where they meet nearest to the points on both, to the nearest point of
  /// the sheet that comes less near it. A crease far from all points is a guess.
  double gap() const { return gap_; }

  /// Comparable with that of one HeightPatch over the same points if they are too few to be
  /// averaged (kMostHeightSamples); the averages of more are told easier than the points
  /// themselves.
  double misfit() const { return first_.patch.misfit() + second_.patch.misfit(); }

 private:
  CreasedPatch(Sheet first, Sheet second, bool convex);

  /// Whether more than a few of the points lie on parts of their sheets that bound no body, for the
  /// other sheet cuts these off.
  bool hides_points(const std::vector<OrientedPoint>& points, double radius) const;

  Sheet first_;
  Sheet second_;
  bool convex_;
  double turn_ = 0.0;
  double bend_ = 0.0;
  double gap_ = 0.0;
};

}  // namespace instep
