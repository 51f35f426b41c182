#pragma once

#include <cstddef>
#include <vector>

#include "core/fusion/fused_scene.h"
#include "core/fusion/views/thin.h"
#include "core/fusion/views/working_view.h"

namespace instep {

/// What one view shows of the feet.
struct FootPoints {
  ViewedCloud points;  ///< above the platform and below the ceiling, seen through by no other view
  std::size_t seen_through = 0;
};

/// Needs the standing height of `scene` and whether the platform was found. Changes nothing, so
/// that several threads may each do one view.
FootPoints foot_points(const std::vector<WorkingView>& views, std::size_t number,
                       const FusionSettings& settings, const FusedScene& scene);

}  // namespace instep
