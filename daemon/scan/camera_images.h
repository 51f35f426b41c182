#pragma once

#include <string>
#include <vector>

#include "core/fusion/frames/temporal_fusion.h"
#include "core/fusion/views/view.h"
#include "core/go_on.h"
#include "core/result.h"
#include "daemon/scan/scan_pipeline.h"

namespace instep {

/// The frames of each camera as one depth image, in the order of `capture.cameras`. A camera
/// without a good frame fails all: a set that is not whole is never used as if it were. Fails with
/// kInsufficientData then, saying what was wrong with the last of its frames, or kCancelled.
Result<std::vector<FusedDepth>> camera_images(const Capture& capture, const GoOn& go_on);

/// Of each camera of which more frames were rejected than used.
std::vector<std::string> rejection_warnings(const std::vector<FusedDepth>& images);

/// The views of the cameras of a capture, by the poses that it gives.
std::vector<View> views_of(const Capture& capture, std::vector<FusedDepth> images);

}  // namespace instep
