#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "daemon/cloud_files/raw_cloud.h"

namespace instep {

/// Reads the bytes of an OBJ or STL file through assimp: corners (as float32) and triangles, all
/// parts of the file together. Corners at the same place become one, so that a surface hangs
/// together. Of an OBJ file only corners and faces are read. Fails with kCorruptData where one of
/// these is none, or assimp makes nothing of it.
Result<RawCloud> read_obj(std::string_view bytes, const std::string& file);
Result<RawCloud> read_stl(std::string_view bytes, const std::string& file);

}  // namespace instep
