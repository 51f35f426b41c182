#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "daemon/cloud_files/scalar_column.h"

namespace instep {

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kFloat32;  ///< of the value, or of a list's items
  std::optional<ScalarType> count_type;    ///< only a list has one
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  /// The place of the property of that name.
  std::optional<std::size_t> find(std::string_view name) const;
};

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::size_t size_bytes = 0;  ///< where the data begin
};

/// Reads the header of a PLY file's bytes. Fails with kCorruptData; `file` is used in messages.
Result<PlyHeader> read_ply_header(std::string_view bytes, const std::string& file);

}  // namespace instep
