#pragma once

#include <string>
#include <string_view>

#include "core/result.h"

namespace instep {

/// The bytes of the points of a PCD file of the kind binary_compressed, and how many of the file's
/// bytes they stood in.
struct UnpackedPcd {
  std::string bytes;
  std::size_t packed_bytes = 0;  ///< with the two sizes before them
};

/// Unpacks what follows the header: the size packed and the size unpacked, of four bytes each, and
/// data packed by LZF. `wanted` is the size unpacked, in bytes, that the header makes. kCorruptData
/// where the sizes or the data contradict this or each other; no memory is taken on the word of the
/// sizes alone.
Result<UnpackedPcd> unpack_pcd(std::string_view packed, double wanted, const std::string& file);

}  // namespace instep
