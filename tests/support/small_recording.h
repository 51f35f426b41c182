#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/fusion/frames/depth_frame.h"
#include "drivers/recording/recording.h"

namespace instep::test {

/// A recording of two cameras, 64 x 48 pixels, with a value of its own in each pixel.
Recording small_header();

/// Frames of it: three rounds of both cameras, 33 ms apart.
std::vector<DepthFrame> small_frames();

/// Writes the two as a recording in `folder`; throws if that fails.
void write_small_recording(const std::filesystem::path& folder);

}  // namespace instep::test
