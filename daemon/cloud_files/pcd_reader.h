#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "daemon/cloud_files/raw_cloud.h"

namespace instep {

/// Reads the bytes of a PCD file, ASCII, binary or compressed, fields of any type in any order: x y
/// z and, if there, normal_x normal_y normal_z. Other fields are passed over. Another kind of data
/// is kUnsupported; a header that lies, data that end early or cannot be unpacked are kCorruptData.
Result<RawCloud> read_pcd(std::string_view bytes, const std::string& file);

}  // namespace instep
