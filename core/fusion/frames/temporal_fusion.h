#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/fusion/frames/depth_frame.h"
#include "core/result.h"

namespace instep {

/// What is known of the noise of a depth sensor before its frames are looked at: it grows with the
/// square of the distance (triangulation). The default is that of structured light and stereo
/// cameras of a 50 to 75 mm baseline at 0.3 to 1 m.
struct SensorNoise {
  double axial_per_mm = 2.9e-6;  ///< sigma of one frame = this * Z^2 (0.7 mm at 0.5 m)

  double axial_sigma_mm(double depth_mm) const { return axial_per_mm * depth_mm * depth_mm; }
};

struct TemporalSettings {
  SensorNoise noise;
  int expected_frames = 4;  ///< room is made for so many at first, and later for more
};

/// Several frames of one camera as one depth image.
struct FusedDepth {
  std::string camera;
  int width = 0;
  int height = 0;
  std::vector<float> depth_mm;  ///< row by row; 0 = no data
  std::vector<float> sigma_mm;  ///< of depth_mm; 0 where there is no data
  int frames_used = 0;
  int frames_rejected = 0;
  double movement_mm = 0.0;  ///< how far surfaces moved along the line of sight during the frames
  bool moved = false;        ///< by more than 1 mm
};

/// Fuses frames as they arrive: per pixel the mean of the values near the median (gate on the
/// median absolute deviation). The sigma of a pixel joins the scatter that was seen with the model
/// of the sensor, and never falls below what repeating cannot remove: the part of a depth step
/// that noise does not dither away, and a tenth of the noise of one frame.
///
/// Keeps the values of each pixel sorted: two bytes a pixel and frame (9 MB for 15 frames of
/// 640x480, 74 MB for 120, which is as much as the frames themselves). Adding costs some 5 ms, the
/// result some 15 ms. One thread at a time.
class TemporalFusion {
 public:
  explicit TemporalFusion(TemporalSettings settings = {});

  /// Takes a frame in, or says why not and counts it as rejected: status not kGood, size or unit
  /// unlike the first frame's or not sound, fewer values than pixels (kCorruptData), nearly nothing
  /// in range, 50 mm to 3 m (kInsufficientData). One beyond 120 is not looked at and not counted,
  /// for nothing is wrong with it.
  Result<void> add(const DepthFrame& frame);

  int frames_used() const { return frames_used_; }
  int frames_rejected() const { return frames_rejected_; }

  /// Fails with kInsufficientData before the first good frame.
  Result<FusedDepth> result() const;

 private:
  Result<void> check(const DepthFrame& frame) const;
  void start(const DepthFrame& frame);
  void widen();
  void note_movement(const DepthFrame& frame);

  TemporalSettings settings_;
  std::string camera_;
  int width_ = 0;
  int height_ = 0;
  double unit_mm_ = 0.0;
  std::uint16_t nearest_raw_ = 0;
  std::uint16_t farthest_raw_ = 0;
  int frames_used_ = 0;
  int frames_rejected_ = 0;
  std::size_t room_ = 0;               ///< values that a pixel has room for
  std::vector<std::uint16_t> sorted_;  ///< pixel by pixel, ascending
  std::vector<std::uint8_t> counts_;
  std::vector<std::uint16_t> first_raw_;  ///< the first frame
  std::vector<float> first_blocks_;       ///< mean depth of its blocks
  double movement_mm_ = 0.0;
};

}  // namespace instep
