#include "core/fusion/seen_through.h"

#include <cmath>

#include "core/fusion/lens.h"

namespace instep {
namespace {

enum class Verdict { kNone, kConfirms, kSeesThrough };

/// A view's camera, ready to take points in.
struct Witness {
  const CameraIntrinsics* intrinsics;
  const FusedDepth* depth;
  RigidTransform camera_from_station;

  Verdict judge(const Eigen::Vector3d& point, double margin_mm) const {
    const Eigen::Vector3d own = camera_from_station * point;
    if (!(own.z() > margin_mm)) return Verdict::kNone;
    const Eigen::Vector2d pixel = pixel_of(*intrinsics, own);
    const double u = std::round(pixel.x());
    const double v = std::round(pixel.y());
    if (!(u >= 1 && v >= 1 && u <= depth->width - 2 && v <= depth->height - 2)) {
      return Verdict::kNone;
    }
    bool through = true;
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        const int at = (static_cast<int>(v) + dv) * depth->width + static_cast<int>(u) + du;
        const double z = depth->depth_mm[static_cast<std::size_t>(at)];
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
};

}  // namespace

std::vector<std::size_t> points_not_seen_through(const ViewedCloud& points,
                                                 const std::vector<PosedDepth>& views,
                                                 double margin_mm) {
  std::vector<Witness> witnesses;
  for (const auto& view : views) {
    witnesses.push_back({view.intrinsics, view.depth, view.station_from_camera.inverse()});
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points.cloud.size(); ++i) {
    bool confirmed = false;
    bool seen_through = false;
    for (std::size_t view = 0; view < witnesses.size() && !confirmed; ++view) {
      if (view == points.views[i]) continue;
      const Verdict verdict = witnesses[view].judge(points.cloud.positions[i], margin_mm);
      confirmed = verdict == Verdict::kConfirms;
      seen_through = seen_through || verdict == Verdict::kSeesThrough;
    }
    if (confirmed || !seen_through) kept.push_back(i);
  }
  return kept;
}

}  // namespace instep
