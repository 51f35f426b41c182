#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace instep {

/// What went wrong, as a closed list. Programs decide by Error::remedy; the code is for tests,
/// statistics and translations.
enum class ErrorCode {
  kInvalidInput,      ///< data or options that cannot be right: NaN, collinear points, a bad name
  kNotFound,          ///< a file, device or scan that is not there
  kPermissionDenied,  ///< there, but not for this user
  kCorruptData,       ///< a file or frame whose content contradicts itself
  kUnsupported,       ///< sound, but not something this program handles
  kInsufficientData,  ///< too few points or frames to measure honestly
  kNoSpace,           ///< the disk is full
  kNoBandwidth,       ///< the bus of the device is full
  kBusy,              ///< somebody else holds it
  kTimeout,           ///< nothing came within the limit
  kDeviceGone,        ///< the device left the bus
  kCancelled,         ///< stopped on request
  kIo,                ///< the operating system failed at reading or writing
  kInternal,          ///< a bug of ours
};

/// What helps. The station's state machine acts on this alone.
enum class Remedy {
  kRetry,     ///< the same call may go through next time
  kReopen,    ///< close the device, open it again
  kReset,     ///< reset the device, then open it again
  kOperator,  ///< a person has to do what Error::advice says
  kBug,       ///< nothing helps but a better program
};

/// A failure as a value. `message` says what happened, `advice` what the operator can do; both are
/// sentences without a final stop, made to be joined on one line.
struct Error {
  ErrorCode code = ErrorCode::kInternal;
  Remedy remedy = Remedy::kBug;
  std::string message;
  std::string advice;

  /// "message: advice", the one line that a user sees.
  std::string line() const { return advice.empty() ? message : message + ": " + advice; }
};

/// The remedy that nearly always goes with a code.
Remedy usual_remedy(ErrorCode code);

/// The code's stable name in files and on the wire, such as "invalid_input".
const char* to_string(ErrorCode code);
const char* to_string(Remedy remedy);

/// A value or the Error that kept it from being there. Errors are returned, never thrown, across
/// folders.
template <typename T>
using Result = tl::expected<T, Error>;

/// Builds the failing side of any Result, with the usual remedy for the code.
///
///     if (points.empty()) {
///       return fail(ErrorCode::kInsufficientData, "the cloud has no points", "scan again");
///     }
inline tl::unexpected<Error> fail(ErrorCode code, std::string message, std::string advice) {
  return tl::make_unexpected(
      Error{code, usual_remedy(code), std::move(message), std::move(advice)});
}

/// The same with a remedy of its own.
inline tl::unexpected<Error> fail(ErrorCode code, Remedy remedy, std::string message,
                                  std::string advice) {
  return tl::make_unexpected(Error{code, remedy, std::move(message), std::move(advice)});
}

}  // namespace instep
