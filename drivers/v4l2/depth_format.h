#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace instep {

/// How a V4L2 camera packs depth: 16 bits a pixel, little-endian, 0 = no data. What one unit is
/// worth is nowhere in V4L2 (the kernel's documentation of Z16 says so) and comes from the
/// settings.
enum class DepthFormat {
  kZ16,   ///< 'Z16 ': depth, row by row (RealSense D4xx, SR300)
  kY16,   ///< 'Y16 ': the same bytes under the name of a grey image (Orbbec, some ToF cameras)
  kInzi,  ///< 'INZI': a plane of 16-bit infrared, then one of depth, of the same size (SR300)
};

/// The V4L2 code of four letters.
std::uint32_t four_letters(DepthFormat format);
/// Such a code as text, without spaces at its end, for messages.
std::string to_string_of_four(std::uint32_t code);

/// What the driver says it agreed to (v4l2_pix_format).
struct AgreedFormat {
  std::uint32_t code = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t bytes_per_line = 0;
  std::uint32_t bytes_per_image = 0;
};

/// Where the depth lies in a buffer.
struct DepthLayout {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t first_byte = 0;      ///< of the first row
  std::size_t bytes_per_line = 0;  ///< from row to row, at least 2 * width
  std::size_t bytes = 0;           ///< a buffer that holds fewer is short
};

/// Drivers answer a wish they cannot fulfil with another format or size and no error: fails with
/// kUnsupported unless the driver agreed to just what was asked, with room for every row.
Result<DepthLayout> depth_layout(DepthFormat format, int width, int height,
                                 const AgreedFormat& agreed);

/// The depth in a buffer of at least layout.bytes, without the padding of its rows.
std::vector<std::uint16_t> read_depth(const DepthLayout& layout, const std::uint8_t* buffer);

}  // namespace instep
