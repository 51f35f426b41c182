#include "core/result.h"

namespace instep {

Remedy usual_remedy(ErrorCode code) {
  switch (code) {
    case ErrorCode::kBusy:
    case ErrorCode::kTimeout:
    case ErrorCode::kCancelled:
    case ErrorCode::kInsufficientData:
      return Remedy::kRetry;
    case ErrorCode::kDeviceGone:
      return Remedy::kReopen;
    case ErrorCode::kInvalidInput:
    case ErrorCode::kNotFound:
    case ErrorCode::kPermissionDenied:
    case ErrorCode::kCorruptData:
    case ErrorCode::kUnsupported:
    case ErrorCode::kNoSpace:
    case ErrorCode::kNoBandwidth:
    case ErrorCode::kIo:
      return Remedy::kOperator;
    case ErrorCode::kInternal:
      return Remedy::kBug;
  }
  return Remedy::kBug;
}

const char* to_string(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidInput:
      return "invalid_input";
    case ErrorCode::kNotFound:
      return "not_found";
    case ErrorCode::kPermissionDenied:
      return "permission_denied";
    case ErrorCode::kCorruptData:
      return "corrupt_data";
    case ErrorCode::kUnsupported:
      return "unsupported";
    case ErrorCode::kInsufficientData:
      return "insufficient_data";
    case ErrorCode::kNoSpace:
      return "no_space";
    case ErrorCode::kNoBandwidth:
      return "no_bandwidth";
    case ErrorCode::kBusy:
      return "busy";
    case ErrorCode::kTimeout:
      return "timeout";
    case ErrorCode::kDeviceGone:
      return "device_gone";
    case ErrorCode::kCancelled:
      return "cancelled";
    case ErrorCode::kIo:
      return "io";
    case ErrorCode::kInternal:
      return "internal";
  }
  return "internal";
}

const char* to_string(Remedy remedy) {
  switch (remedy) {
    case Remedy::kRetry:
      return "retry";
    case Remedy::kReopen:
      return "reopen";
    case Remedy::kReset:
      return "reset";
    case Remedy::kOperator:
      return "operator";
    case Remedy::kBug:
      return "bug";
  }
  return "bug";
}

}  // namespace instep
