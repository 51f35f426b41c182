#pragma once

#include <vector>

#include "core/fusion/frames/temporal_fusion.h"

namespace instep {

/// Frames that are all there, as one depth image.
inline Result<FusedDepth> fuse_frames(const std::vector<DepthFrame>& frames,
                                      const TemporalSettings& settings = {}) {
  TemporalFusion fusion(settings);
  for (const auto& frame : frames) (void)fusion.add(frame);  // it counts what it rejects
  return fusion.result();
}

}  // namespace instep
