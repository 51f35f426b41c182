#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/foot/measuring_rules.h"

namespace instep {

/// By how many radians (counter-clockwise from above) the axis of a rule is turned from the x axis
/// of a foot that stands roughly along it: asked again after turning, it comes to rest. For all
/// rules but that of the second toe. Nothing where the points do not show what the rule needs.
///
/// `points`: those near the floor at full size (full_size.h), right-foot form, pternion at the
/// origin, z up.
std::optional<double> axis_turn(AxisRule rule, const std::vector<Eigen::Vector3d>& points,
                                double length_mm);

/// How far the middle between the heel's borders lies to the left of the x axis, over its rear 0.03
/// to 0.13 of the length. Points as above. Nothing where a border was not seen.
std::optional<double> heel_middle(const std::vector<Eigen::Vector3d>& points, double length_mm);

}  // namespace instep
