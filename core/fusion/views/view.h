#pragma once

#include <memory>

#include "core/fusion/frames/deprojector.h"
#include "core/fusion/frames/depth_frame.h"
#include "core/fusion/frames/temporal_fusion.h"

namespace instep {

/// What one camera saw.
struct View {
  CameraGeometry geometry;
  FusedDepth depth;
  /// The camera's rays, if the caller keeps them; else they are computed anew (2 to 20 ms), in the
  /// view's own job.
  std::shared_ptr<const Deprojector> rays;
};

}  // namespace instep
