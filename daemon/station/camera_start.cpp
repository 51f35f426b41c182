#include "daemon/station/camera_start.h"

namespace instep {

Result<void> start_by(DepthCamera& camera, std::chrono::steady_clock::time_point deadline,
                      const GoOn& go_on) {
  while (true) {
    auto started = camera.start();
    if (!go_on()) return cancelled();
    const bool is_late = std::chrono::steady_clock::now() >= deadline;
    if (started || is_late || !is_on_its_way(started.error())) return started;
  }
}

bool is_on_its_way(const Error& error_of_start) {
  return error_of_start.code == ErrorCode::kTimeout && error_of_start.remedy == Remedy::kRetry;
}

}  // namespace instep
