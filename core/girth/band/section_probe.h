#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>

#include "core/girth/band/slab_source.h"
#include "core/result.h"

namespace instep {

/// Fewer points than this make no section.
inline constexpr std::size_t kFewestPoints = 24;
/// Points nearer than this part of the section tell no more than fewer would.
inline constexpr double kFinestGrain = 0.0075;
/// Of so many points the spacing is asked for.
inline constexpr std::size_t kSpacingSample = 200;

/// Where the section at a tape plane lies and how fine it is.
struct SectionProbe {
  Eigen::Vector3d middle_mm;
  double unit_mm = 1.0;  ///< the diagonal of the section
  double spacing = 0.0;  ///< of points on the skin, in the unit
  /// How far to both sides of the middle points belong to the section, in the unit: what lies
  /// further off strays.
  Eigen::Array2d reach = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  double stray_share = 0.0;  ///< of the points, so far off

  /// Points within `half_width` of the plane and the reach, seen from it, in the unit.
  PlaneSlab slab(SlabSource& slabs, double half_width) const;
};

/// Widens a slab until it is a ring of points that tells their spacing, and that of the lines that
/// they may stand in: where they are far apart, `slabs` are thinned for good. Fails with
/// kInvalidInput where too few points lie near the plane, kInsufficientData where they form no
/// surface. O(n), and m log m for the m that are looked at.
Result<SectionProbe> probe_section(SlabSource& slabs);

/// Thins slabs that are not, where their points stand in lines that are far apart but as thick with
/// noise that probe_section() does not see them. False where they do not. Some 40 times O(m) for
/// the m points near the plane.
bool thin_thick_lines(SlabSource& slabs);

}  // namespace instep
