#include "tests/support/simulated_capture.h"

#include <chrono>
#include <utility>

namespace instep::test {

Result<Capture> capture_of(SimulatedStation& station) {
  constexpr int kFrames = 15;
  Capture capture;
  capture.simulated = true;
  capture.platform_height_mm = station.platform_height_mm;
  for (const auto& camera : station.cameras) {
    capture.cameras.push_back(camera->description());
    if (auto started = camera->start(); !started) return tl::make_unexpected(started.error());
    for (int i = 0; i < kFrames; ++i) {
      auto frame = camera->next_frame(std::chrono::seconds(1));
      if (!frame) return tl::make_unexpected(frame.error());
      capture.frames.push_back(std::move(*frame));
    }
  }
  return capture;
}

}  // namespace instep::test
