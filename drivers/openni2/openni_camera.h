#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "core/geometry/rigid_transform.h"
#include "drivers/depth_camera.h"
#include "drivers/openni2/frame_numbers.h"
#include "drivers/openni2/openni_child.h"

namespace instep {

/// A sensor that OpenNI2 drives (Carmine, Xtion, or what a maker's own driver knows), read by a
/// process of its own: instep-openni, which alone links that library.
///
/// The library can block for ever, crash and deadlock, and keeps state for all sensors of a
/// process. Therefore each sensor has a process: what goes wrong with one takes no other along, it
/// is ended by force, and what the library leaks at each plugging in goes with it. A process costs
/// some 10 MB. Processes take turns in opening, since a sensor tells its serial number only once it
/// is open. A process lives as long as its sensor is open; stop() leaves both ready for the next
/// scan.
///
/// The image is set to 640x480, or the size of the intrinsics, in the finest depth unit, not
/// mirrored, its holes not filled, not projected into the colour camera, for close range where the
/// sensor has one; all but the last are read back, and a sensor that does otherwise is refused.
/// The projector is on while the stream runs, and for some 50 ms after stop().
///
/// A frame is kCorrupt if its size or format is not that of the mode or a value is larger than the
/// sensor says it can be, and kIncomplete if it has too little data. DepthFrame::sequence is the
/// sensor's, carried on over restarts, and host_time the time at which OpenNI2 handed the frame
/// over.
class OpenniCamera final : public DepthCamera {
 public:
  struct Settings {
    std::string name;    ///< CameraGeometry::id
    std::string serial;  ///< empty = the only sensor there is
    RigidTransform station_from_camera = RigidTransform::Identity();
    /// Nothing = a pinhole with the field of view that the sensor says, its axis in the middle:
    /// right to some pixels, for a start.
    std::optional<CameraIntrinsics> intrinsics;
    OpenniProgram program;
    std::chrono::milliseconds opening_limit = SensorChoice().opening_limit;
  };

  /// Opens the sensor, within the opening limit from its turn on, see SearchTurn. Fails with
  /// kNotFound if it is not there, kBusy or kPermissionDenied if it cannot be had, kUnsupported if
  /// it cannot be set as above or has no field of view and no intrinsics were given, kDeviceGone if
  /// it was lost, kIo if its driver crashed or hung.
  static Result<std::unique_ptr<OpenniCamera>> open(Settings settings);

  const CameraDescription& description() const override { return description_; }
  /// Opens the sensor again if it was lost, wherever it is plugged in now. If that takes more than
  /// a second it fails with kTimeout and goes on by itself, up to the opening limit from its turn
  /// on: call again.
  /// What it says meanwhile is why the sensor had to be opened again, if that is known.
  Result<void> start() override;
  Result<DepthFrame> next_frame(std::chrono::milliseconds limit) override;
  void stop() override;
  void interrupt() override;

 private:
  explicit OpenniCamera(Settings settings) : settings_(std::move(settings)) {}

  Result<void> launch();
  Result<void> bring_to_stream();
  /// Ends the child for what is wrong with it.
  void drop_child(const Error& cause);
  Result<void> describe(const CameraOpened& opened);
  Result<void> check_same(const CameraOpened& opened) const;
  DepthFrame to_frame(RingFrame frame);

  Settings settings_;
  CameraDescription description_;
  std::unique_ptr<OpenniChild> child_;  ///< none = has to be launched
  std::optional<Error> dropped_for_;    ///< why the last child was; until a stream begins
  bool started_ = false;
  FrameNumbers numbers_;
  std::chrono::steady_clock::time_point last_host_time_{};

  WakeUp interrupt_;
};

}  // namespace instep
