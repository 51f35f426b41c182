#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace instep {

/// A depth image as a recording keeps it: 16-bit grey, 0 = no data.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> raw;  ///< width * height values, row by row
};

/// Reads the bytes of a PNG file. `name` is used in messages. Fails with kCorruptData (no PNG,
/// truncated, a wrong checksum, too short) or kUnsupported (not 16-bit grey, or larger than
/// kLargestImageSide, which is checked before memory is taken).
Result<DepthImage> decode_depth_png(std::string_view bytes, const std::string& name);

/// The same from a file; also fails as read_file_bytes() does.
Result<DepthImage> read_depth_png(const std::filesystem::path& path);

/// The bytes of a PNG file, compressed for speed. `image.raw` must hold width * height values
/// (kInvalidInput otherwise). The same image gives the same bytes.
Result<std::string> encode_depth_png(const DepthImage& image);

}  // namespace instep
