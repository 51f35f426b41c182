#pragma once

#include <Eigen/Core>

#include "core/fusion/fused_scene.h"

namespace instep {

/// Whether a point of the station lies near enough to the platform to matter: within 600 mm of its
/// middle in plan and 500 in height. What does not is background.
bool in_region(const Eigen::Vector3d& point, const FusionSettings& settings);

}  // namespace instep
