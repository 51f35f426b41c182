#include "daemon/cloud_files/pcd_reader.h"

#include <fmt/core.h>

#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "daemon/cloud_files/pcd_compression.h"
#include "daemon/cloud_files/scalar_column.h"
#include "daemon/cloud_files/text_tokens.h"

namespace instep {
namespace {

constexpr std::size_t kMostFields = 256;
constexpr double kMostFieldValues = 65536;

constexpr std::string_view kAscii = "ascii";
constexpr std::string_view kBinary = "binary";
constexpr std::string_view kCompressed = "binary_compressed";

struct PcdField {
  std::string name;
  std::size_t size = 4;
  char kind = 'F';
  std::size_t count = 1;
  std::size_t offset = 0;  ///< in bytes (binary) from the start of a point
  std::size_t column = 0;  ///< in words (ASCII) from the start of a line
};

struct PcdHeader {
  std::vector<PcdField> fields;
  double width = 0;
  double height = 1;
  std::optional<double> points;
  std::string data;
  std::size_t stride = 0;
  std::size_t columns = 0;
  std::size_t size_bytes = 0;
};

/// Of a line that is too long one more than it may have, so that it is not taken for a shorter one.
std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::size_t kMostWords = 1 + kMostFields + 1;  // the key, the fields, one too many
  std::vector<std::string_view> words;
  for (auto word = take_word(line); !word.empty() && words.size() < kMostWords;
       word = take_word(line)) {
    words.push_back(word);
  }
  return words;
}

/// Non-negative whole number or nothing.
std::optional<double> whole_in(std::string_view word) {
  const auto value = number_in(word);
  if (!value || !(*value >= 0 && *value < 1e15) || *value != std::floor(*value)) return {};
  return value;
}

/// One line of the header; false if it makes no sense.
bool take_line(const std::vector<std::string_view>& words, PcdHeader& header) {
  const std::string_view key = words[0];
  if (key == "VERSION" || key == "VIEWPOINT") return true;
  if (words.size() < 2) return false;
  if (key == "FIELDS" || key == "COLUMNS") {
    header.fields.assign(words.size() - 1, {});
    for (std::size_t i = 1; i < words.size(); ++i) header.fields[i - 1].name = words[i];
    return header.fields.size() <= kMostFields;
  }
  if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
    if (words.size() - 1 != header.fields.size()) return false;
    for (std::size_t i = 1; i < words.size(); ++i) {
      auto& field = header.fields[i - 1];
      const auto number = whole_in(words[i]);
      if (key == "TYPE") {
        field.kind = words[i][0];
      } else if (!number || *number > kMostFieldValues) {
        return false;
      } else {
        (key == "SIZE" ? field.size : field.count) = static_cast<std::size_t>(*number);
      }
    }
    return true;
  }
  const auto number = whole_in(words[1]);
  if (key == "WIDTH" && number) return header.width = *number, true;
  if (key == "HEIGHT" && number) return header.height = *number, true;
  if (key == "POINTS" && number) return header.points = *number, true;
  return false;
}

Result<PcdHeader> read_header(std::string_view bytes, const std::string& file) {
  PcdHeader header;
  TextLines lines(bytes);
  while (const auto line = lines.next()) {
    const auto words = words_of(*line);
    if (words.empty() || words[0][0] == '#') continue;
    if (words[0] == "DATA" && words.size() > 1) {
      header.data = words[1];
      break;
    }
    if (!take_line(words, header)) {
      return damaged_file(file, fmt::format("its PCD header has a line that makes no sense, \"{}\"",
                                            line->substr(0, 60)));
    }
  }
  if (header.data.empty()) return damaged_file(file, "its PCD header has no DATA line");
  for (auto& field : header.fields) {
    field.offset = header.stride;
    field.column = header.columns;
    header.stride += field.size * field.count;
    header.columns += field.count;
  }
  header.size_bytes = bytes.size() - lines.rest().size();
  return header;
}

std::optional<ScalarType> type_of(const PcdField& field) {
  if (field.count != 1) return {};
  if (field.kind == 'F' && field.size == 4) return ScalarType::kFloat32;
  if (field.kind == 'F' && field.size == 8) return ScalarType::kFloat64;
  if (field.kind == 'I' && field.size == 1) return ScalarType::kInt8;
  if (field.kind == 'I' && field.size == 2) return ScalarType::kInt16;
  if (field.kind == 'I' && field.size == 4) return ScalarType::kInt32;
  if (field.kind == 'U' && field.size == 1) return ScalarType::kUint8;
  if (field.kind == 'U' && field.size == 2) return ScalarType::kUint16;
  if (field.kind == 'U' && field.size == 4) return ScalarType::kUint32;
  return {};
}

struct Target {
  PcdField field;
  ScalarType type;
  ColumnTarget out;
};

const PcdField* find_field(const PcdHeader& header, std::string_view name) {
  for (const auto& field : header.fields) {
    if (field.name == name && type_of(field)) return &field;
  }
  return nullptr;
}

/// Makes room for three fields in `vectors` and says where they go; false if one is missing.
bool want_vectors(const PcdHeader& header, const std::array<const char*, 3>& names,
                  std::size_t count, std::vector<Eigen::Vector3d>& vectors,
                  std::vector<Target>& targets) {
  for (const char* name : names) {
    if (find_field(header, name) == nullptr) return false;
  }
  vectors.resize(count);
  for (std::size_t i = 0; i < 3 && count > 0; ++i) {
    const PcdField& field = *find_field(header, names[i]);
    targets.push_back({field, *type_of(field), {vectors.front().data() + i, 3}});
  }
  return true;
}

/// Takes the points off the front of `text`.
Result<void> read_ascii(std::string_view& text, const PcdHeader& header, std::size_t count,
                        const std::vector<Target>& targets, const std::string& file) {
  // A row that holds more would be read as another point.
  if (const auto words = words_in_first_row(text); words > header.columns) {
    return damaged_file(
        file, fmt::format("its rows hold {} numbers, its header names {}", words, header.columns));
  }
  std::vector<double> row(header.columns);
  for (std::size_t point = 0; point < count; ++point) {
    for (auto& value : row) {
      const auto number = number_in(take_word(text));
      if (!number) {
        return damaged_file(
            file, fmt::format("it is cut short or holds no numbers from point {} on", point));
      }
      value = *number;
    }
    for (const auto& target : targets) {
      target.out.first[point * target.out.step] = row[target.field.column];
    }
  }
  return {};
}

/// How many points the header names, if so many can be in a file: of those that are not compressed,
/// in `size` bytes.
Result<std::size_t> count_points(const PcdHeader& header, std::size_t size,
                                 const std::string& file) {
  const double wanted = header.points.value_or(header.width * header.height);
  const std::size_t least =
      std::max<std::size_t>(header.data == kAscii ? 2 * header.columns : header.stride, 1);
  const std::size_t last_end = header.data == kAscii ? 1 : 0;  // a line's, which may be missing
  if (header.data != kCompressed && wanted > static_cast<double>((size + last_end) / least)) {
    return damaged_file(file,
                        fmt::format("it is too short for the {} points of its header", wanted));
  }
  if (wanted > static_cast<double>(kMostFilePoints)) {
    return fail(ErrorCode::kUnsupported, fmt::format("{} has {} points", file, wanted),
                fmt::format("thin it out to at most {}", kMostFilePoints));
  }
  return static_cast<std::size_t>(wanted);
}

/// Of points one behind the other, or, if they were compressed, of all values of the first field,
/// of the second ...
void read_binary(std::string_view points, const PcdHeader& header, std::size_t count,
                 const std::vector<Target>& targets) {
  constexpr bool kSwapped = std::endian::native != std::endian::little;
  const bool by_field = header.data == kCompressed;
  for (const auto& target : targets) {
    const std::size_t start = target.field.offset * (by_field ? count : 1);
    const std::size_t stride = by_field ? target.field.size : header.stride;
    copy_column(points.data() + start, stride, count, target.type, kSwapped, target.out);
  }
}

const char* format_name(std::string_view data) {
  if (data == kAscii) return "PCD, ASCII";
  return data == kBinary ? "PCD, binary" : "PCD, compressed";
}

}  // namespace

Result<RawCloud> read_pcd(std::string_view bytes, const std::string& file) {
  const auto header = read_header(bytes, file);
  if (!header) return tl::make_unexpected(header.error());
  if (header->data != kAscii && header->data != kBinary && header->data != kCompressed) {
    return fail(
        ErrorCode::kUnsupported,
        fmt::format("{} holds PCD data of the kind \"{}\"", file, header->data.substr(0, 40)),
        "export it as PCD of the kind ascii, binary or binary_compressed, or as PLY");
  }
  auto rest = bytes.substr(header->size_bytes);
  const auto count = count_points(*header, rest.size(), file);
  if (!count) return tl::make_unexpected(count.error());
  const double size = static_cast<double>(*count) * static_cast<double>(header->stride);
  UnpackedPcd unpacked;
  if (header->data == kCompressed && *count > 0) {
    auto done = unpack_pcd(rest, size, file);
    if (!done) return tl::make_unexpected(done.error());
    unpacked = std::move(*done);
  }

  RawCloud raw;
  raw.format = format_name(header->data);
  std::vector<Target> targets;
  if (!want_vectors(*header, {"x", "y", "z"}, *count, raw.cloud.positions, targets)) {
    return damaged_file(file, "its points lack x, y or z");
  }
  want_vectors(*header, {"normal_x", "normal_y", "normal_z"}, *count, raw.cloud.normals, targets);
  if (*count == 0) return raw;
  if (header->data == kAscii) {
    if (auto good = read_ascii(rest, *header, *count, targets, file); !good) {
      return tl::make_unexpected(good.error());
    }
  } else if (header->data == kBinary) {
    read_binary(rest, *header, *count, targets);
    rest.remove_prefix(*count * header->stride);
  } else {
    read_binary(unpacked.bytes, *header, *count, targets);
    rest.remove_prefix(unpacked.packed_bytes);
  }
  raw.surplus_bytes = without_blanks_at_end(rest).size();
  return raw;
}

}  // namespace instep
