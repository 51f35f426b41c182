#include "daemon/station/camera_errors.h"

namespace instep {

Error named_after_camera(const std::string& camera, Error error) {
  const std::string name = "camera " + camera;
  const bool is_named =
      error.message.starts_with(name + " ") || error.message.starts_with(name + ":");
  if (!is_named) error.message = name + ": " + error.message;
  return error;
}

Error silent_camera(const std::string& camera) {
  return {ErrorCode::kTimeout, Remedy::kReopen, "camera " + camera + " does not answer",
          "unplug it and plug it in again; if that does not help, restart instepd"};
}

}  // namespace instep
