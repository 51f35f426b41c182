#include "drivers/recording/depth_png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <random>

namespace instep {
namespace {

DepthImage noise_image(int width, int height, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  DepthImage image{width, height, {}};
  image.raw.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (auto& value : image.raw) value = static_cast<std::uint16_t>(random());
  return image;
}

/// A PNG of another kind, by libpng's simplified interface.
std::string png_of_format(png_uint_32 format, std::size_t channels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 20;
  image.height = 20;
  image.format = format;
  const std::vector<std::uint8_t> pixels(20 * 20 * channels, 77);
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr);
  return bytes;
}

TEST(DepthPng, GivesBackEveryValue) {
  const auto image = noise_image(37, 21, 1);
  const auto bytes = encode_depth_png(image);
  ASSERT_TRUE(bytes);
  const auto again = decode_depth_png(*bytes, "x.png");
  ASSERT_TRUE(again) << again.error().line();
  EXPECT_EQ(again->width, 37);
  EXPECT_EQ(again->height, 21);
  EXPECT_EQ(again->raw, image.raw);
  EXPECT_EQ(*encode_depth_png(image), *bytes);
}

TEST(DepthPng, StoresTheHighByteFirstAsPngDemands) {
  const auto bytes = encode_depth_png({1, 1, {0x1234}});
  ASSERT_TRUE(bytes);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&image, bytes->data(), bytes->size()));
  EXPECT_EQ(image.format, PNG_FORMAT_LINEAR_Y);
  png_image_free(&image);
}

TEST(DepthPng, RefusesEightBits) {
  const auto image = decode_depth_png(png_of_format(PNG_FORMAT_GRAY, 1), "x.png");
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(image.error().line().find("16-bit grey"), std::string::npos);
}

TEST(DepthPng, RefusesColour) {
  const auto image = decode_depth_png(png_of_format(PNG_FORMAT_RGB, 3), "x.png");
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kUnsupported);
}

TEST(DepthPng, RefusesEveryTruncation) {
  const auto bytes = encode_depth_png(noise_image(16, 16, 2));
  ASSERT_TRUE(bytes);
  for (std::size_t size = 0; size < bytes->size(); ++size) {
    const auto image = decode_depth_png(std::string_view(*bytes).substr(0, size), "x.png");
    ASSERT_FALSE(image) << size;
    ASSERT_EQ(image.error().code, ErrorCode::kCorruptData) << size;
  }
}

TEST(DepthPng, NoticesEveryFlippedByte) {
  const auto image = noise_image(16, 16, 3);
  const auto bytes = encode_depth_png(image);
  ASSERT_TRUE(bytes);
  for (std::size_t place = 0; place < bytes->size(); ++place) {
    std::string flipped = *bytes;
    flipped[place] = static_cast<char>(flipped[place] ^ 0x10);
    const auto read = decode_depth_png(flipped, "x.png");
    ASSERT_TRUE(!read || read->raw == image.raw) << place;
  }
}

TEST(DepthPng, RefusesHugeSizesBeforeTakingMemory) {
  // The header of a PNG of 60000 x 60000 pixels, with a right checksum and nothing behind.
  std::string bytes("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xea\x60\0\0\xea\x60\x10\0\0\0\0", 29);
  std::uint32_t crc = 0xffffffffU;
  for (std::size_t i = 12; i < bytes.size(); ++i) {
    crc ^= static_cast<std::uint8_t>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  crc = ~crc;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(crc >> shift);
  bytes += std::string("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12);
  const auto image = decode_depth_png(bytes, "x.png");
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kUnsupported) << image.error().line();
}

TEST(DepthPng, RefusesToWriteWhatDoesNotFit) {
  EXPECT_FALSE(encode_depth_png({4, 4, std::vector<std::uint16_t>(15)}));
  EXPECT_FALSE(encode_depth_png({0, 4, {}}));
}

}  // namespace
}  // namespace instep
