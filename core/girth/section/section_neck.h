#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/girth/band/plane_band.h"
#include "core/girth/contour/contour.h"

namespace instep {

/// The narrowest place of a section between two parts that are both far wider than it, as of an
/// hourglass, or of two bodies that touch. In the unit of the contour.
struct SectionNeck {
  Eigen::Vector2d from;  ///< a place on the contour
  Eigen::Vector2d to;    ///< the one across the neck
  double width = 0.0;    ///< straight between them

  /// Nothing of a section that has none: a part of less than a twentieth of the area is none, nor
  /// is one along which two sides run, as a fin, nor where a round part is less than twice as wide.
  /// Each end is told to a two-hundredth of the length. O(corners).
  static std::optional<SectionNeck> of(const Contour& contour);
};

/// Whether two bodies that touch, or nearly, may have been taken for one: a neck of the section is
/// no wider than its points can tell, or points lie along all of it, inside, as those of the two
/// skins that face each other there do. Of the two lengths, of both bodies and of the larger one,
/// nothing tells which it is. O(points of the band).
bool may_be_two_bodies(const PlaneBand& band, const SectionNeck& neck);

}  // namespace instep
