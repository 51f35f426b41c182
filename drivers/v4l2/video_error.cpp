#include "drivers/v4l2/video_error.h"

#include <cerrno>
#include <cstring>

#include "drivers/files/system_user.h"

namespace instep {

Error video_error(int number, const std::string& doing) {
  const std::string message = doing + " failed: " + std::strerror(number);
  switch (number) {
    case ENODEV:
    case ENXIO:
    case ENOENT:
      return {ErrorCode::kDeviceGone, Remedy::kReopen, "it is unplugged (" + message + ")",
              "plug it in again"};
    case EBUSY:
      // uvcvideo also says this for a moment while the hub above wakes up or loses a device.
      return {ErrorCode::kBusy, Remedy::kRetry,
              "another program has it, or its bus is not ready (" + message + ")",
              "if it stays so, end that program: fuser -v /dev/video* names it"};
    case EACCES:
    case EPERM:
      return {ErrorCode::kPermissionDenied, Remedy::kOperator, message,
              command_to_join("video") + ", then log in again, or start instepd again"};
    case EMFILE:
    case ENFILE:
    case ENOMEM:
      return {ErrorCode::kIo, Remedy::kRetry, message,
              "the machine is short of memory or open files; if it stays so, restart instepd"};
    case EINVAL:
    case ENOTTY:
      return {ErrorCode::kUnsupported, Remedy::kOperator, message,
              "its driver cannot do that: use another mode or camera"};
    default:
      return {ErrorCode::kIo, Remedy::kReopen, message,
              "unplug it and plug it in again; check its cable"};
  }
}

}  // namespace instep
