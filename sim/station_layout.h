#pragma once

#include <string>
#include <vector>

#include "core/fusion/depth_frame.h"
#include "core/result.h"

namespace instep {

/// Where the cameras of a station stand: evenly round the platform's centre, all looking at a point
/// above it, upright. Those at the sides stand low enough to see the walls of a foot nearly down to
/// its rim and in under its arch, those before and behind it high enough to see its back over the
/// toes, and the platform.
struct LayoutSettings {
  int cameras = 4;             ///< 1..16
  int width_px = 640;          ///< 16..4096
  int height_px = 480;         ///< 16..4096
  double distance_mm = 500.0;  ///< 200..3000, from the eye to the point looked at
  double target_height_mm = 60.0;
  /// Above the horizon; cameras alternate between the two.
  double low_elevation_deg = 10.0;
  double high_elevation_deg = 35.0;
  /// Of the first camera, counter-clockwise seen from above, 0 = in front of the toes (+x).
  double first_azimuth_deg = 0.0;
};

/// The cameras, in order of azimuth. Four of them are called front, left, back and right (as the
/// customer sees it, who looks along +x); other numbers camera-1, camera-2 and so on. Lenses have
/// the field of view of the PrimeSense family (58 by 45 degrees at 4:3), without distortion.
Result<std::vector<CameraGeometry>> lay_out_station(const LayoutSettings& settings);

}  // namespace instep
