#pragma once

#include <string>
#include <vector>

#include "core/fusion/frames/depth_frame.h"
#include "core/result.h"

namespace instep {

struct LayoutSettings {
  int cameras = 4;      ///< 1..16
  int width_px = 640;   ///< 16..4096
  int height_px = 480;  ///< 16..4096
};

/// The cameras of a station: evenly round the platform's centre, all looking at a point above it
/// from 500 mm away, upright. Those at the sides stand low enough to see the walls of a foot nearly
/// down to its rim and in under its arch, those before and behind it high enough to see its back
/// over the toes, and the platform.
///
/// In order of azimuth, counter-clockwise seen from above, the first in front of the toes (+x).
/// Four of them are called front, left, back and right (as the customer sees it, who looks along
/// +x); other numbers camera-1, camera-2 and so on. Lenses have the field of view of the PrimeSense
/// family (58 by 45 degrees at 4:3), without distortion.
Result<std::vector<CameraGeometry>> lay_out_station(const LayoutSettings& settings);

}  // namespace instep
