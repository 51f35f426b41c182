#include "daemon/cloud_files/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "daemon/cloud_files/raw_cloud.h"
#include "daemon/cloud_files/text_tokens.h"

namespace instep {
namespace {

constexpr std::size_t kLongestHeader_bytes = std::size_t{1} << 20;
constexpr std::size_t kMostElements = 64;
constexpr std::size_t kMostProperties = 256;

std::optional<ScalarType> type_named(std::string_view name) {
  struct Named {
    std::string_view name;
    ScalarType type;
  };
  static constexpr std::array kTypes = {
      Named{"char", ScalarType::kInt8},      Named{"int8", ScalarType::kInt8},
      Named{"uchar", ScalarType::kUint8},    Named{"uint8", ScalarType::kUint8},
      Named{"short", ScalarType::kInt16},    Named{"int16", ScalarType::kInt16},
      Named{"ushort", ScalarType::kUint16},  Named{"uint16", ScalarType::kUint16},
      Named{"int", ScalarType::kInt32},      Named{"int32", ScalarType::kInt32},
      Named{"uint", ScalarType::kUint32},    Named{"uint32", ScalarType::kUint32},
      Named{"float", ScalarType::kFloat32},  Named{"float32", ScalarType::kFloat32},
      Named{"double", ScalarType::kFloat64}, Named{"float64", ScalarType::kFloat64}};
  for (const auto& named : kTypes) {
    if (named.name == name) return named.type;
  }
  return std::nullopt;
}

/// Each takes the rest of a header line behind its keyword; false if the line makes no sense.
bool take_format(std::string_view rest, PlyHeader& header) {
  const auto name = take_word(rest);
  if (name == "ascii") {
    header.format = PlyFormat::kAscii;
  } else if (name == "binary_little_endian") {
    header.format = PlyFormat::kLittleEndian;
  } else if (name == "binary_big_endian") {
    header.format = PlyFormat::kBigEndian;
  } else {
    return false;
  }
  return take_word(rest) == "1.0";
}

bool take_element(std::string_view rest, PlyHeader& header) {
  PlyElement element;
  element.name = take_word(rest);
  const auto count = take_word(rest);
  const auto end = count.data() + count.size();
  const auto [stop, error] = std::from_chars(count.data(), end, element.count);
  if (element.name.empty() || count.empty() || stop != end || error != std::errc{}) return false;
  header.elements.push_back(std::move(element));
  return header.elements.size() <= kMostElements;
}

bool take_property(std::string_view rest, PlyHeader& header) {
  if (header.elements.empty()) return false;
  PlyProperty property;
  auto type = take_word(rest);
  if (type == "list") {
    property.count_type = type_named(take_word(rest));
    if (!property.count_type || !is_whole(*property.count_type)) return false;
    type = take_word(rest);
  }
  const auto known = type_named(type);
  property.name = take_word(rest);
  if (!known || property.name.empty()) return false;
  property.type = *known;
  auto& properties = header.elements.back().properties;
  properties.push_back(std::move(property));
  return properties.size() <= kMostProperties;
}

}  // namespace

std::optional<std::size_t> PlyElement::find(std::string_view wanted) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == wanted) return i;
  }
  return std::nullopt;
}

Result<PlyHeader> read_ply_header(std::string_view bytes, const std::string& file) {
  const std::string_view text = bytes.substr(0, kLongestHeader_bytes);
  TextLines lines(text);
  lines.next();  // "ply", known to the caller
  PlyHeader header;
  bool has_format = false;
  while (const auto line = lines.next()) {
    std::string_view rest = *line;
    const auto keyword = take_word(rest);
    bool good = true;
    if (keyword == "format") {
      good = has_format = take_format(rest, header);
    } else if (keyword == "element") {
      good = take_element(rest, header);
    } else if (keyword == "property") {
      good = take_property(rest, header);
    } else if (keyword == "end_header") {
      if (!has_format) return damaged_file(file, "its PLY header names no format");
      header.size_bytes = text.size() - lines.rest().size();
      return header;
    } else {
      good = keyword == "comment" || keyword == "obj_info" || keyword.empty();
    }
    if (!good) {
      return damaged_file(file, "its PLY header has a line that makes no sense, \"" +
                                    std::string(line->substr(0, 60)) + "\"");
    }
  }
  return damaged_file(file, "its PLY header has no end");
}

}  // namespace instep
