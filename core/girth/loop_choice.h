#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace instep {

/// Of the closed loops that a plane cuts out of a body (two toes, two feet), the one round the
/// largest area, turned counter-clockwise; the others are named in `warnings`. At least one loop.
std::vector<Eigen::Vector2d> choose_loop(std::vector<std::vector<Eigen::Vector2d>> loops,
                                         std::vector<std::string>& warnings);

/// What a warning says of a loop that was not chosen.
std::string other_loop_warning(double length_mm);

}  // namespace instep
