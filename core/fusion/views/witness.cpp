#include "core/fusion/views/witness.h"

#include <cmath>

#include "core/fusion/frames/lens.h"

namespace instep {

Witness::Witness(const PosedDepth& view)
    : intrinsics_(view.intrinsics),
      depth_(view.depth),
      camera_from_station_(view.station_from_camera.inverse()) {}

Verdict Witness::judge(const Eigen::Vector3d& in_station, double margin_mm) const {
  const Eigen::Vector3d own = camera_from_station_ * in_station;
  if (!(own.z() > margin_mm)) return Verdict::kNone;
  const auto pixel = pixel_seeing(*intrinsics_, own);
  if (!pixel) return Verdict::kNone;
  const int u = pixel->x();
  const int v = pixel->y();
  if (u < 1 || v < 1 || u > depth_->width - 2 || v > depth_->height - 2) return Verdict::kNone;
  bool through = true;
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      const int at = (v + dv) * depth_->width + u + du;
      const double z = depth_->depth_mm[static_cast<std::size_t>(at)];
      if (!(z > 0.0)) {
        through = false;
      } else if (std::abs(z - own.z()) <= margin_mm) {
        return Verdict::kConfirms;
      } else if (z < own.z()) {
        through = false;
      }
    }
  }
  return through ? Verdict::kSeesThrough : Verdict::kNone;
}

}  // namespace instep
