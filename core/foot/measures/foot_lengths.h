#pragma once

#include <string>

#include "core/foot/foot_scan.h"
#include "core/result.h"

namespace instep {

/// Straight measures of a foot, read off its landmarks (find_landmarks()); millimetres, and degrees
/// for the angles. Each fails with kInsufficientData, naming it, where a landmark was not found.
/// `landmarks` are in the foot's frame; the floor is z = 0.

/// Where a landmark is.
Result<Eigen::Vector3d> position_of(const Landmarks& landmarks, const std::string& name);

/// Pternion to the foremost toe, parallel to the axis.
Result<double> foot_length(const Landmarks& landmarks);

/// Metatarsale tibiale to metatarsale fibulare, in floor projection.
Result<double> foot_breadth(const Landmarks& landmarks);

/// Extent of the outline at right angles to the axis over the ball (0.50-0.85 of the length).
Result<double> foot_breadth_horizontal(const Landmarks& landmarks);

/// Extent of the outline at right angles to the axis, where HeelBreadthRule has it.
Result<double> heel_breadth(const Landmarks& landmarks);

/// Pternion to metatarsale tibiale, and to metatarsale fibulare, along the axis.
Result<double> ball_length(const Landmarks& landmarks);
Result<double> outside_ball_length(const Landmarks& landmarks);

/// Heights over the floor.
Result<double> instep_height(const Landmarks& landmarks);
Result<double> ball_height(const Landmarks& landmarks);
Result<double> toe1_height(const Landmarks& landmarks);

/// Of the arch point over the floor; fails where nobody saw the underside.
Result<double> arch_height(const Landmarks& landmarks);

/// By how many degrees the first toe turns towards the others: between the line from the heel's
/// medial point to metatarsale tibiale and that from there to the toe's contact. And the same of
/// the little toe, by the lateral points.
Result<double> toe1_angle(const Landmarks& landmarks);
Result<double> toe5_angle(const Landmarks& landmarks);

}  // namespace instep
