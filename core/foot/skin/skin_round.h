#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// Whether skin was seen all round a place of it that reaches furthest along `outwards` (unit
/// length), at full size (full_size.h). Where it is missing to one side the place is the rim of a
/// hole, or of a scan that was cut off, and the body itself may reach further.
///
/// Looked at along `outwards`, the points 6 to 12 mm off, or to the 40th nearest where these lie
/// further apart, have to leave no gap of 130 degrees or more round the place, and one point to be
/// near it. What lies deeper than 20 mm, or than 0.6 of a place's height where it faces up, is the
/// body's other side. Below the floor, z = 0, nothing is missing: of a circle that reaches there
/// the gap is as large a part of the rest. Holes less than 30 mm wide pass: rules bridge them.
/// O(n).
bool is_skin_all_round(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& place,
                       const Eigen::Vector3d& outwards);

}  // namespace instep
