#include "drivers/v4l2/depth_format.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

namespace instep {
namespace {

constexpr std::size_t kBytesPerPixel = 2;

}  // namespace

std::uint32_t four_letters(DepthFormat format) {
  switch (format) {
    case DepthFormat::kZ16:
      return V4L2_PIX_FMT_Z16;
    case DepthFormat::kY16:
      return V4L2_PIX_FMT_Y16;
    case DepthFormat::kInzi:
      return V4L2_PIX_FMT_INZI;
  }
  return 0;
}

std::string to_string_of_four(std::uint32_t code) {
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) {
    const auto letter = static_cast<char>((code >> shift) & 0x7f);
    text += letter >= ' ' && letter < '\x7f' ? letter : '?';
  }
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

Result<DepthLayout> depth_layout(DepthFormat format, int width, int height,
                                 const AgreedFormat& agreed) {
  const std::uint32_t code = four_letters(format);
  if (agreed.code != code || agreed.width != static_cast<std::uint32_t>(width) ||
      agreed.height != static_cast<std::uint32_t>(height)) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("it sends {} {}x{}, not {} {}x{}", to_string_of_four(agreed.code),
                            agreed.width, agreed.height, to_string_of_four(code), width, height),
                "set format and the width and height of the intrinsics to a mode it has: "
                "v4l2-ctl --list-formats-ext");
  }
  DepthLayout layout{agreed.width, agreed.height, 0, agreed.bytes_per_line, 0};
  const std::size_t row = kBytesPerPixel * layout.width;
  if (format == DepthFormat::kInzi) {
    // Drivers give the line of both planes together, of 4 bytes a pixel, yet the planes follow one
    // another with rows of their own.
    layout.first_byte = row * layout.height;
    layout.bytes_per_line = row;
  }
  layout.bytes = layout.first_byte + layout.bytes_per_line * (layout.height - 1) + row;
  if (agreed.bytes_per_line < row || agreed.bytes_per_image < layout.bytes) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("its driver has {} bytes a line and {} an image for {}x{}",
                            agreed.bytes_per_line, agreed.bytes_per_image, width, height),
                "choose another mode, or report this camera's driver");
  }
  return layout;
}

std::vector<std::uint16_t> read_depth(const DepthLayout& layout, const std::uint8_t* buffer) {
  std::vector<std::uint16_t> depth(layout.width * layout.height);
  std::uint16_t* pixel = depth.data();
  for (std::size_t row = 0; row < layout.height; ++row) {
    const std::uint8_t* byte = buffer + layout.first_byte + row * layout.bytes_per_line;
    for (std::size_t column = 0; column < layout.width; ++column, byte += kBytesPerPixel) {
      *pixel++ = static_cast<std::uint16_t>(byte[0] | byte[1] << 8);
    }
  }
  return depth;
}

}  // namespace instep
