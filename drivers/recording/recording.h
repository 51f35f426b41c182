#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drivers/depth_camera.h"

namespace instep {

/// One depth image of a recording.
struct RecordedFrame {
  std::string camera;                 ///< CameraGeometry::id
  std::filesystem::path file;         ///< PNG, relative to the recording's folder, never outside it
  std::chrono::microseconds time{0};  ///< on one clock for all cameras of the recording
};

/// A folder with `recording.json` (format "instep-recording", version 1) beside the PNG files of
/// its frames: everything but the pixels. Lengths in millimetres.
struct Recording {
  std::filesystem::path folder;
  std::vector<CameraDescription> cameras;
  std::vector<RecordedFrame> frames;         ///< in the order of the file
  std::optional<double> platform_height_mm;  ///< z of the standing surface, station frame
  std::map<std::string, double> truth;       ///< measure id -> true value, if simulated
  bool simulated = false;

  const CameraDescription* find_camera(const std::string& id) const {
    for (const auto& camera : cameras) {
      if (camera.geometry.id == id) return &camera;
    }
    return nullptr;
  }
};

inline constexpr const char* kRecordingFileName = "recording.json";
inline constexpr std::size_t kMostRecordingCameras = 64;
inline constexpr std::size_t kMostRecordingFrames = 100000;

}  // namespace instep
