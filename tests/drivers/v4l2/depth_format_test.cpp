#include "drivers/v4l2/depth_format.h"

#include <gtest/gtest.h>

#include <cstring>

namespace instep {
namespace {

std::uint32_t code(const char* four) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(four[i]);
  return value;
}

TEST(DepthFormat, HasTheCodesOfTheKernelsDocumentation) {
  EXPECT_EQ(four_letters(DepthFormat::kZ16), code("Z16 "));
  EXPECT_EQ(four_letters(DepthFormat::kY16), code("Y16 "));
  EXPECT_EQ(four_letters(DepthFormat::kInzi), code("INZI"));
  EXPECT_EQ(to_string_of_four(code("Z16 ")), "Z16");
  EXPECT_EQ(to_string_of_four(0x80000001), "????") << "big-endian flag and unprintables";
}

TEST(DepthFormat, ReadsRowsWithoutTheirPadding) {
  // 3 x 2 pixels, rows of 10 bytes.
  const AgreedFormat agreed{code("Y16 "), 3, 2, 10, 20};
  const auto layout = depth_layout(DepthFormat::kY16, 3, 2, agreed);
  ASSERT_TRUE(layout) << layout.error().line();
  EXPECT_EQ(layout->bytes, 16U) << "the padding of the last row need not be there";
  const std::uint8_t buffer[] = {1, 0, 2, 0, 3, 1, 9, 9, 9, 9, 4, 0, 5, 0, 255, 255};
  EXPECT_EQ(read_depth(*layout, buffer), (std::vector<std::uint16_t>{1, 2, 259, 4, 5, 65535}));
}

TEST(DepthFormat, TakesTheSecondPlaneOfInzi) {
  // The line is given for both planes together by some drivers, for one by others.
  for (const std::uint32_t line : {4U, 8U}) {
    const auto layout =
        depth_layout(DepthFormat::kInzi, 2, 2, AgreedFormat{code("INZI"), 2, 2, line, 16});
    ASSERT_TRUE(layout) << layout.error().line();
    EXPECT_EQ(layout->bytes, 16U);
    const std::uint8_t buffer[] = {9, 9, 9, 9, 9, 9, 9, 9, 1, 0, 2, 0, 3, 0, 4, 0};
    EXPECT_EQ(read_depth(*layout, buffer), (std::vector<std::uint16_t>{1, 2, 3, 4}));
  }
}

// Drivers change what they do not like, and say nothing.
TEST(DepthFormat, RefusesWhatWasNotAskedFor) {
  const AgreedFormat good{code("Z16 "), 64, 48, 128, 6144};
  ASSERT_TRUE(depth_layout(DepthFormat::kZ16, 64, 48, good));
  const auto refused = [&](auto change) {
    AgreedFormat other = good;
    change(other);
    const auto layout = depth_layout(DepthFormat::kZ16, 64, 48, other);
    return !layout && layout.error().code == ErrorCode::kUnsupported;
  };
  EXPECT_TRUE(refused([](auto& format) { format.code = code("YUYV"); }));
  EXPECT_TRUE(refused([](auto& format) { format.width = 32; }));
  EXPECT_TRUE(refused([](auto& format) { format.height = 96; }));
  EXPECT_TRUE(refused([](auto& format) { format.bytes_per_line = 127; }));
  EXPECT_TRUE(refused([](auto& format) { format.bytes_per_line = 0; }));
  EXPECT_TRUE(refused([](auto& format) { format.bytes_per_image = 6143; }));
  EXPECT_TRUE(refused([](auto& format) { format.bytes_per_line = 0xFFFFFFFF; }));
}

}  // namespace
}  // namespace instep
