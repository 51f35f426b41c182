#pragma once

#include <cstdint>

#include "daemon/scan/scan_pipeline.h"

namespace instep::test {

/// How the depths of each camera are bent, the same in all of its frames.
struct BentCamera {
  double sigma_mm = 0.0;  ///< at half a metre; it grows as the square of the depth
  double width_px = 0.0;  ///< standard deviation of the bell that white noise was smoothed by
};

/// Bends the depths of a capture, each camera's otherwise.
void bend_depths(const BentCamera& bent, std::uint64_t seed, Capture& capture);

}  // namespace instep::test
