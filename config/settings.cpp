#include "config/settings.h"

#include <fmt/format.h>

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

std::string describe_camera(const CameraSettings& camera,
                            const SimulatedStationSettings& simulation) {
  if (camera.kind == CameraKind::kRecording) return "the recording " + camera.path.string();
  if (camera.kind == CameraKind::kOpenni) return describe(camera.openni);
  if (camera.kind == CameraKind::kV4l2) return describe(camera.v4l2);
  return fmt::format("{} simulated", simulation.cameras);
}

std::string describe_keeping(const StoreSettings& store) {
  std::string text;
  if (store.keep_days > 0) text += fmt::format(", kept for {} days", store.keep_days);
  if (store.keep_count > 0) text += fmt::format(", at most {}", store.keep_count);
  return text.empty() ? ", kept for ever" : text;
}

std::string describe_pedal(const PedalSettings& pedal) {
  switch (pedal.kind) {
    case PedalKind::kNone:
      return "none";
    case PedalKind::kSimulated:
      return "simulated, taps are written to " + pedal.fifo.string();
    case PedalKind::kGpio:
      return describe(pedal.gpio);
    case PedalKind::kEvdev:
      return describe(pedal.evdev);
  }
  return "";
}

std::string describe_sizes(const SizeRules& sizes) {
  std::string text = fmt::format("lasts {} mm longer than the foot", sizes.allowance_mm);
  for (const auto& table : sizes.shop_tables) {
    text += fmt::format(", {} with {} sizes", table.name, table.sizes.size());
  }
  return text;
}

}  // namespace

const CameraPlacement* CameraSettings::placement() const {
  return placement_of(*this);
}

CameraPlacement* CameraSettings::placement() {
  return placement_of(*this);
}

std::string describe(const Settings& settings) {
  const auto& [station, capture, pedal, outputs, cameras, simulation, store, measures, sizes,
               control, log, calibration] = settings;
  std::string text = fmt::format("station  {}, points every {} mm, side {}\n", station.name,
                                 station.point_spacing_mm,
                                 station.side ? to_string(*station.side) : "told from the shape");
  for (const auto& camera : cameras) {
    const bool is_rough = camera.placement() != nullptr && camera.placement()->is_rough;
    text += fmt::format("cameras  {}{}\n", describe_camera(camera, simulation),
                        is_rough ? ", placed by tape measure" : "");
  }
  if (calibration) text += describe(*calibration);
  text += fmt::format("capture  {} frames of each camera after {} to warm up, within {} ms\n",
                      capture.frames_per_camera, capture.warmup_frames, capture.deadline.count());
  text += fmt::format("pedal    {}\n", describe_pedal(pedal));
  for (const auto& [name, output] : outputs.named()) {
    text += fmt::format("output   {}: {}\n", name, describe(*output));
  }
  text += fmt::format("store    {}{}\n", store.root.string(), describe_keeping(store));
  text += fmt::format("measures {}\n", in_words(measures));
  text += fmt::format("sizes    {}\n", describe_sizes(sizes));
  text += fmt::format("control  {}\n", control.socket.string());
  return text;
}

}  // namespace instep
