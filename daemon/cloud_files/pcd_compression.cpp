#include "daemon/cloud_files/pcd_compression.h"

#include <fmt/core.h>
#include <lzf.h>

#include <bit>
#include <cstdint>

#include "daemon/cloud_files/raw_cloud.h"
#include "daemon/cloud_files/scalar_column.h"

namespace instep {
namespace {

constexpr std::size_t kSizes_bytes = 8;

/// The longest repetition that LZF knows, of 264 bytes, takes three.
constexpr double kMostFromOneByte = 88.0;

std::uint32_t size_at(const char* address) {
  constexpr bool kSwapped = std::endian::native != std::endian::little;
  return static_cast<std::uint32_t>(scalar_loader(ScalarType::kUint32, kSwapped)(address));
}

}  // namespace

Result<UnpackedPcd> unpack_pcd(std::string_view packed, double wanted, const std::string& file) {
  if (packed.size() < kSizes_bytes) return damaged_file(file, "it is cut short");
  const std::uint32_t size = size_at(packed.data());
  const std::uint32_t unpacked = size_at(packed.data() + kSizes_bytes / 2);
  if (size > packed.size() - kSizes_bytes) return damaged_file(file, "it is cut short");
  if (static_cast<double>(unpacked) != wanted) {
    return damaged_file(
        file, fmt::format("its points take {} bytes, by its header {}", unpacked, wanted));
  }
  if (unpacked > kMostFromOneByte * size) {
    return damaged_file(file,
                        fmt::format("{} bytes cannot hold the {} of its points", size, unpacked));
  }
  UnpackedPcd result;
  result.packed_bytes = kSizes_bytes + size;
  result.bytes.resize(unpacked);
  if (unpacked == 0) return result;
  if (lzf_decompress(packed.data() + kSizes_bytes, size, result.bytes.data(), unpacked) !=
      unpacked) {
    return damaged_file(file, "its compressed points cannot be unpacked");
  }
  return result;
}

}  // namespace instep
