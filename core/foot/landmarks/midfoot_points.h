#pragma once

#include <optional>

#include "core/foot/foot_scan.h"
#include "core/foot/skin/foot_outline.h"

namespace instep {

/// The ridge of the foot's back at half its length, over the middle cuneiform. Right-foot form, as
/// all here. Nothing where the cloud has no points there, or only the rim of a hole
/// (skin_round.h), as below.
std::optional<Landmark> find_instep_point(const FootOutline& outline);

/// The point of the lateral outline nearest to the instep point in floor projection.
std::optional<Landmark> find_lateral_midfoot(const FootOutline& outline, const Landmark& instep);

/// The point of the medial outline through which a tape over the other two is shortest.
std::optional<Landmark> find_medial_arch(const FootOutline& outline, const Landmark& instep,
                                         const Landmark& lateral);

/// The highest place of the underside a quarter of the outline's breadth inwards from the medial
/// border, in 0.35-0.60 of the foot's length. All points must be evidence.
std::optional<Landmark> find_arch_point(const FootOutline& outline);

/// A landmark of the outline as a tape's control point: on the floor below it. The outline's wall
/// is steep, so its own height says little and would only tilt the tape.
Eigen::Vector3d on_floor(const Eigen::Vector3d& point);

}  // namespace instep
