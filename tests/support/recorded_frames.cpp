#include "tests/support/recorded_frames.h"

#include <png.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/geometry/pose_rows.h"

namespace instep {
namespace {

/// The values of a 16-bit grey PNG.
void read_png(const std::string& path, DepthFrame& frame) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) throw std::runtime_error("cannot open " + path);
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file.get());
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  frame.width = static_cast<int>(png_get_image_width(png, info));
  frame.height = static_cast<int>(png_get_image_height(png, info));
  png_bytepp rows = png_get_rows(png, info);
  for (int v = 0; v < frame.height; ++v) {
    for (int u = 0; u < frame.width; ++u) {
      frame.raw.push_back(static_cast<std::uint16_t>(rows[v][2 * u] << 8 | rows[v][2 * u + 1]));
    }
  }
  png_destroy_read_struct(&png, &info, nullptr);
}

CameraGeometry camera_from(const nlohmann::json& json) {
  CameraGeometry camera;
  camera.id = json.at("id");
  auto& lens = camera.intrinsics;
  lens.width = json.at("width");
  lens.height = json.at("height");
  lens.fx = json.at("fx");
  lens.fy = json.at("fy");
  lens.cx = json.at("cx");
  lens.cy = json.at("cy");
  if (json.contains("distortion")) lens.distortion = json.at("distortion");
  camera.station_from_camera = nearest_rigid(matrix_from_rows(json.at("station_from_camera")));
  return camera;
}

}  // namespace

RecordedFrames read_recorded_frames(const std::string& folder) {
  std::ifstream file(folder + "/recording.json");
  const auto json = nlohmann::json::parse(file);
  RecordedFrames recorded;
  for (const auto& camera : json.at("cameras")) recorded.cameras.push_back(camera_from(camera));
  for (const auto& entry : json.at("frames")) {
    DepthFrame frame;
    frame.camera = entry.at("camera");
    read_png(folder + "/" + std::string(entry.at("file")), frame);
    for (const auto& camera : json.at("cameras")) {
      if (camera.at("id") == frame.camera) frame.depth_unit_mm = camera.at("depth_unit_mm");
    }
    recorded.frames.push_back(std::move(frame));
  }
  return recorded;
}

}  // namespace instep
