#include "tests/support/small_recording.h"

#include <stdexcept>

#include "drivers/recording/recording_writer.h"

namespace instep::test {

Recording small_header() {
  Recording header;
  header.platform_height_mm = -1.25;
  for (const char* id : {"left", "right"}) {
    CameraDescription camera;
    camera.geometry.id = id;
    camera.geometry.intrinsics = {64, 48, 70.1, 70.2, 31.3, 23.4, {0.01, -0.02, 0.001, 0.002, 0.0}};
    camera.geometry.station_from_camera.linear() =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    camera.geometry.station_from_camera.translation() = Eigen::Vector3d(1.5, -400.25, 300.125);
    camera.model = "Model 1";
    camera.serial = "0042";
    camera.depth_unit_mm = 0.1;
    header.cameras.push_back(camera);
  }
  return header;
}

std::vector<DepthFrame> small_frames() {
  std::vector<DepthFrame> frames;
  for (std::uint64_t round = 0; round < 3; ++round) {
    for (const char* id : {"left", "right"}) {
      DepthFrame frame;
      frame.camera = id;
      frame.sequence = round;
      frame.width = 64;
      frame.height = 48;
      frame.depth_unit_mm = 0.1;
      frame.device_time = std::chrono::microseconds(1000000 + round * 33000);
      for (std::size_t i = 0; i < 64 * 48; ++i) {
        frame.raw.push_back(static_cast<std::uint16_t>(i * 21 + round * 1000 + frames.size()));
      }
      frames.push_back(frame);
    }
  }
  return frames;
}

void write_small_recording(const std::filesystem::path& folder) {
  auto writer = RecordingWriter::create(folder, small_header());
  if (!writer) throw std::runtime_error(writer.error().line());
  for (const auto& frame : small_frames()) {
    if (auto good = writer->add_frame(frame); !good) throw std::runtime_error(good.error().line());
  }
  if (auto good = writer->finish(); !good) throw std::runtime_error(good.error().line());
}

}  // namespace instep::test
