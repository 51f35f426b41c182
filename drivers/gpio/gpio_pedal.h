#pragma once

#include <filesystem>
#include <memory>

#include "drivers/gpio/gpio_line.h"
#include "drivers/pedal.h"

namespace instep {

enum class GpioBias { kPullUp, kPullDown, kNone };

/// A pedal on a GPIO line: a contact that closes the line to ground (active low, pulled up by the
/// chip), or the other way round. Edges carry the kernel's own time stamps, taken in the interrupt
/// (CLOCK_MONOTONIC since Linux 5.7). The kernel keeps 16 edges that nobody reads and drops newer
/// ones, so a burst may end unseen: is_pressed() asks the line itself.
///
/// When a chip leaves (a USB board is pulled), Linux 6.1 does not wake those who wait for its
/// lines. So the folder of device nodes is watched too (inotify), and whenever a node goes the
/// line is asked whether it is still there. That costs nothing at rest.
class GpioPedal final : public Pedal {
 public:
  struct Settings {
    GpioLineAddress address;
    bool active_low = true;             ///< pressed means a low level
    GpioBias bias = GpioBias::kPullUp;  ///< chips without bias resistors ignore it
    std::filesystem::path devices = "/dev";
  };

  /// Fails as GpioLine::find does, and with kBusy (the message names the holder) if the line is in
  /// use. Worth another try later.
  static Result<std::unique_ptr<GpioPedal>> open(const Settings& settings);

  ~GpioPedal() override;

  int descriptor() const override;
  Result<std::vector<PedalEdge>> read_edges() override;
  Result<bool> is_pressed() override;
  Result<void> reopen() override;

 private:
  struct Connection;

  explicit GpioPedal(const Settings& settings);
  Result<void> connect();
  tl::unexpected<Error> gone();

  Settings settings_;
  std::unique_ptr<Connection> connection_;  ///< null between a reopen() that failed and the next
  bool gone_ = false;
};

}  // namespace instep
