#pragma once

#include <string>
#include <vector>

#include "core/fusion/frames/depth_frame.h"

namespace instep {

/// A recording folder as plain values, for tests of the core that must not depend on the product's
/// reader. Trusts the folder; throws what its libraries throw.
struct RecordedFrames {
  std::vector<CameraGeometry> cameras;
  std::vector<DepthFrame> frames;
};

RecordedFrames read_recorded_frames(const std::string& folder);

}  // namespace instep
