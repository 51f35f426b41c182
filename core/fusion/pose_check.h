#pragma once

#include <vector>

#include "core/fusion/fused_scene.h"
#include "core/fusion/views/working_view.h"
#include "core/go_on.h"
#include "core/result.h"
#include "core/workers.h"

namespace instep {

/// Whether the poses and lenses of the views fit each other: fits them (register_views()) and, if
/// `settings` wants them refined, moves and stretches the views to where they do, drops those that
/// do not, and tells each what is left unknown of it. What was found goes to the scene's figures
/// and warnings. Fails with kCancelled, or as Deprojector::create() does.
Result<void> check_poses(const FusionSettings& settings, const Workers& workers, const GoOn& go_on,
                         std::vector<WorkingView>& views, FusedScene& scene);

}  // namespace instep
