#pragma once

#include <vector>

#include "core/fusion/fused_scene.h"
#include "core/fusion/views/view.h"
#include "core/go_on.h"
#include "core/result.h"
#include "core/workers.h"

namespace instep {

/// From one depth image a camera to the clouds of the feet, each with normals, sigma, view
/// directions, origins, where overlaps show that depths are bent the errors that neighbours share
/// (LocalErrors) and, where the views were refined, those that are left of their poses and lenses
/// (PointCloud::shared_errors_mm). Pure computation; the same views give the same bytes, in
/// whatever order (they are taken by name, which differ). What concerns one view alone is a job of
/// its own for `workers`, the rest runs on the calling thread. `go_on` hears of each view, each
/// iteration of the registration, and each stage.
///
/// Fails with kInvalidInput where a pose or lens is not sound or there is no view, kCorruptData
/// where a depth image does not fit its camera, kInsufficientData where no camera saw anything,
/// where views see through each other's feet even without the one that is contradicted most, or no
/// foot stands there, kCancelled. A camera that saw nothing while others did, or was left out so,
/// is a warning.
Result<FusedScene> fuse_views(const std::vector<View>& views, const FusionSettings& settings = {},
                              const Workers& workers = one_after_the_other,
                              const GoOn& go_on = always);

}  // namespace instep
