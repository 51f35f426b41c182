#include "drivers/recording/depth_png.h"

#include <fmt/core.h>
#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>

#include "core/fusion/frames/camera_limits.h"
#include "drivers/files/file_bytes.h"

// libpng reports errors by a long jump. The functions between setjmp and the jump (this file's
// steps_*) therefore own nothing that needs a destructor; all memory belongs to the callers.

namespace instep {
namespace {

constexpr std::size_t kMostPngBytes = std::size_t{256} << 20;

/// What libpng's callbacks work on.
struct PngTask {
  const char* input = nullptr;
  std::size_t input_left = 0;
  std::string* output = nullptr;
  std::array<char, 160> message{};
};

[[noreturn]] void keep_message_and_jump(png_structp png, png_const_charp message) {
  auto* task = static_cast<PngTask*>(png_get_error_ptr(png));
  std::strncpy(task->message.data(), message, task->message.size() - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void take_input(png_structp png, png_bytep target, std::size_t count) {
  auto* task = static_cast<PngTask*>(png_get_io_ptr(png));
  if (count > task->input_left) png_error(png, "the file ends too early");
  std::memcpy(target, task->input, count);
  task->input += count;
  task->input_left -= count;
}

void append_output(png_structp png, png_bytep source, std::size_t count) {
  auto* task = static_cast<PngTask*>(png_get_io_ptr(png));
  bool kept = true;
  try {
    task->output->append(static_cast<const char*>(static_cast<const void*>(source)), count);
  } catch (const std::bad_alloc&) {
    kept = false;  // an exception must not run through libpng's frames
  }
  if (!kept) png_error(png, "no memory left");
}

void flush_nothing(png_structp) {}

/// A libpng reader that is destroyed at the end of the scope.
struct PngReader {
  PngTask task;
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, &task, keep_message_and_jump, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

  PngReader() = default;
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct PngWriter {
  PngTask task;
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &task, keep_message_and_jump, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

  PngWriter() = default;
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

bool steps_read_header(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_read_fn(reader.png, &reader.task, take_input);
  // Only the sizes that a depth image can have may cost memory.
  png_set_user_limits(reader.png, 1U << 20, 1U << 20);
  png_set_chunk_malloc_max(reader.png, 1U << 20);
  png_set_crc_action(reader.png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_read_info(reader.png, reader.info);
  return true;
}

bool steps_read_rows(PngReader& reader, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  if constexpr (std::endian::native == std::endian::little) png_set_swap(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

bool steps_write(PngWriter& writer, png_uint_32 width, png_uint_32 height, png_bytepp rows) {
  if (setjmp(png_jmpbuf(writer.png)) != 0) return false;
  png_set_write_fn(writer.png, &writer.task, append_output, flush_nothing);
  png_set_compression_level(writer.png, 1);
  png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_IHDR(writer.png, writer.info, width, height, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writer.png, writer.info);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(writer.png);
  png_write_image(writer.png, rows);
  png_write_end(writer.png, nullptr);
  return true;
}

/// libpng wants a pointer to each row, and not const ones even where it only reads.
std::vector<png_bytep> row_pointers(std::uint16_t* raw, std::size_t width, std::size_t height) {
  std::vector<png_bytep> rows(height);
  for (std::size_t row = 0; row < height; ++row) {
    rows[row] = static_cast<png_bytep>(static_cast<void*>(raw + row * width));
  }
  return rows;
}

tl::unexpected<Error> damaged(const std::string& name, const char* reason) {
  return fail(ErrorCode::kCorruptData, fmt::format("{} is a damaged PNG ({})", name, reason),
              "record or copy it again");
}

Result<void> check_header(const PngReader& reader, const std::string& name) {
  const auto width = png_get_image_width(reader.png, reader.info);
  const auto height = png_get_image_height(reader.png, reader.info);
  const int depth = png_get_bit_depth(reader.png, reader.info);
  if (png_get_color_type(reader.png, reader.info) != PNG_COLOR_TYPE_GRAY || depth != 16) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{} is no 16-bit grey PNG ({} bits in {} channels)", name, depth,
                            png_get_channels(reader.png, reader.info)),
                "store raw depth as 16-bit grey, one channel");
  }
  constexpr auto kLargest = static_cast<png_uint_32>(kLargestImageSide);
  if (width > kLargest || height > kLargest) {
    return fail(ErrorCode::kUnsupported, fmt::format("{} has {} x {} pixels", name, width, height),
                fmt::format("a depth image has at most {0} x {0}", kLargest));
  }
  return {};
}

}  // namespace

Result<DepthImage> decode_depth_png(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) {
    return fail(ErrorCode::kCorruptData, name + " is empty", "record or copy it again");
  }
  PngReader reader;
  if (reader.info == nullptr) {
    return fail(ErrorCode::kIo, "no memory to read " + name, "close other programs");
  }
  reader.task.input = bytes.data();
  reader.task.input_left = bytes.size();
  if (!steps_read_header(reader)) return damaged(name, reader.task.message.data());
  if (const auto good = check_header(reader, name); !good) {
    return tl::make_unexpected(good.error());
  }

  DepthImage image;
  image.width = static_cast<int>(png_get_image_width(reader.png, reader.info));
  image.height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  image.raw.resize(width * height);
  auto rows = row_pointers(image.raw.data(), width, height);
  if (!steps_read_rows(reader, rows.data())) return damaged(name, reader.task.message.data());
  return image;
}

Result<DepthImage> read_depth_png(const std::filesystem::path& path) {
  const auto bytes = read_file_bytes(path, kMostPngBytes);
  if (!bytes) return tl::make_unexpected(bytes.error());
  return decode_depth_png(*bytes, path.string());
}

Result<std::string> encode_depth_png(const DepthImage& image) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  if (image.width < 1 || image.height < 1 || image.width > kLargestImageSide ||
      image.height > kLargestImageSide || image.raw.size() != width * height) {
    return fail(ErrorCode::kInvalidInput,
                fmt::format("a depth image of {} x {} pixels holds {} values", image.width,
                            image.height, image.raw.size()),
                "hand in one value for each pixel");
  }
  PngWriter writer;
  if (writer.info == nullptr) {
    return fail(ErrorCode::kIo, "no memory to write a PNG", "close other programs");
  }
  std::string bytes;
  bytes.reserve(image.raw.size() + 1024);
  writer.task.output = &bytes;
  std::vector<std::uint16_t> raw = image.raw;
  auto rows = row_pointers(raw.data(), width, height);
  if (!steps_write(writer, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                   rows.data())) {
    return fail(ErrorCode::kInternal, fmt::format("libpng: {}", writer.task.message.data()),
                "report this");
  }
  return bytes;
}

}  // namespace instep
