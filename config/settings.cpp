#include "config/settings.h"

#include <algorithm>

namespace instep {
namespace {

/// Of constant settings a constant one.
template <typename Camera>
auto placement_of(Camera& camera) -> decltype(&camera.openni.placement) {
  switch (camera.kind) {
    case CameraKind::kOpenni:
      return &camera.openni.placement;
    case CameraKind::kV4l2:
      return &camera.v4l2.placement;
    case CameraKind::kSimulated:
    case CameraKind::kRecording:
      return nullptr;
  }
  return nullptr;
}

}  // namespace

const CameraPlacement* CameraSettings::placement() const {
  return placement_of(*this);
}

CameraPlacement* CameraSettings::placement() {
  return placement_of(*this);
}

bool Settings::has_simulated_parts() const {
  return pedal.kind == PedalKind::kSimulated ||
         std::any_of(cameras.begin(), cameras.end(),
                     [](const auto& camera) { return camera.kind == CameraKind::kSimulated; });
}

}  // namespace instep
