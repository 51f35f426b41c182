#pragma once

#include <Eigen/Core>

#include "core/fusion/frames/depth_frame.h"
#include "core/fusion/frames/temporal_fusion.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// A depth image with its camera and pose, borrowed for as long as it is used.
struct PosedDepth {
  const CameraIntrinsics* intrinsics = nullptr;
  const FusedDepth* depth = nullptr;
  RigidTransform station_from_camera = RigidTransform::Identity();
};

enum class Verdict { kNone, kConfirms, kSeesThrough };

/// A camera that is asked whether a surface can be at a place: it knows what lies in that line of
/// sight. Borrows what its PosedDepth does. A question costs some 0.05 us; from any thread.
class Witness {
 public:
  explicit Witness(const PosedDepth& view);

  /// Confirms it where one of the 3 x 3 pixels there shows a surface within `margin_mm` of the
  /// place, along the optical axis; sees through it where all of them lie further behind. Nothing
  /// out of view, before the rim of the image, where a pixel has no data, or behind a surface.
  Verdict judge(const Eigen::Vector3d& in_station, double margin_mm) const;

 private:
  const CameraIntrinsics* intrinsics_;
  const FusedDepth* depth_;
  RigidTransform camera_from_station_;
};

}  // namespace instep
