#include "daemon/station/recovery_ladder.h"

#include <fmt/format.h>

#include "daemon/station/camera_start.h"

namespace instep {

RecoveryLadder::Step RecoveryLadder::failed(const Error& error) {
  // What goes on by itself would only begin anew.
  if (is_on_its_way(error)) return Step::kReopen;
  // There is nothing to reset where nothing is plugged in, and no use in it where a person has to
  // change something.
  away_ = error.code == ErrorCode::kDeviceGone || error.code == ErrorCode::kNotFound;
  // A device that has just arrived may not be opened until udev has set who may.
  const bool udev_may_come = error.code == ErrorCode::kPermissionDenied && reopens_ < kReopens;
  hopeless_ = !away_ && !udev_may_come &&
              (error.remedy == Remedy::kOperator || error.remedy == Remedy::kBug);
  if (away_) return Step::kReopen;
  if (hopeless_) return Step::kOperator;
  if (error.remedy == Remedy::kReset) reopens_ = kReopens;
  if (reopens_ < kReopens) {
    ++reopens_;
    return Step::kReopen;
  }
  // What another program holds would be taken from it.
  if (can_reset_ && error.code != ErrorCode::kBusy && resets_ < kResets) {
    ++resets_;
    return Step::kReset;
  }
  hopeless_ = true;
  return Step::kOperator;
}

void RecoveryLadder::recovered() {
  *this = RecoveryLadder(can_reset_);
}

std::string RecoveryLadder::text() const {
  if (away_) return "waits until it is plugged in";
  if (hopeless_) return "needs a person";
  if (resets_ > 0) return fmt::format("USB reset {} of {}", resets_, kResets);
  if (reopens_ > 0) return fmt::format("opened again, {} of {}", reopens_, kReopens);
  return {};
}

}  // namespace instep
