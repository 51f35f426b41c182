#include "daemon/cloud_files/pcd_reader.h"

#include <fmt/core.h>

#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "daemon/cloud_files/scalar_column.h"
#include "daemon/cloud_files/text_tokens.h"

namespace instep {
namespace {

constexpr std::size_t kMostFields = 256;
constexpr double kMostFieldValues = 65536;

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

}  // namespace

Result<RawCloud> read_pcd(std::string_view bytes, const std::string& file) {
  const auto header = read_header(bytes, file);
  if (!header) return tl::make_unexpected(header.error());
  if (header->data != "ascii" && header->data != "binary") {
    return fail(
        ErrorCode::kUnsupported,
        fmt::format("{} holds PCD data of the kind \"{}\"", file, header->data.substr(0, 40)),
        "convert it with pcl_convert_pcd_ascii_binary to ascii (0) or binary (1)");
  }
  const bool ascii = header->data == "ascii";
  auto rest = bytes.substr(header->size_bytes);
  const double wanted = header->points.value_or(header->width * header->height);
  const std::size_t least = std::max<std::size_t>(ascii ? 2 * header->columns : header->stride, 1);
  if (wanted > static_cast<double>((rest.size() + 1) / least)) {
    return damaged_file(file,
                        fmt::format("it is too short for the {} points of its header", wanted));
  }
  if (wanted > static_cast<double>(kMostFilePoints)) {
    return fail(ErrorCode::kUnsupported, fmt::format("{} has {} points", file, wanted),
                fmt::format("thin it out to at most {}", kMostFilePoints));
  }
  const auto count = static_cast<std::size_t>(wanted);

  RawCloud raw;
  raw.format = ascii ? "PCD, ASCII" : "PCD, binary";
  std::vector<Target> targets;
  if (!want_vectors(*header, {"x", "y", "z"}, count, raw.cloud.positions, targets)) {
    return damaged_file(file, "its points lack x, y or z");
  }
  want_vectors(*header, {"normal_x", "normal_y", "normal_z"}, count, raw.cloud.normals, targets);
  if (count == 0) return raw;
  if (ascii) {
    if (auto good = read_ascii(rest, *header, count, targets, file); !good) {
      return tl::make_unexpected(good.error());
    }
    raw.surplus_bytes = without_blanks_at_end(rest).size();
    return raw;
  }
  if (rest.size() / least < count) return damaged_file(file, "it is cut short");
  constexpr bool kSwapped = std::endian::native != std::endian::little;
  for (const auto& target : targets) {
    copy_column(rest.data() + target.field.offset, header->stride, count, target.type, kSwapped,
                target.out);
  }
  raw.surplus_bytes = without_blanks_at_end(rest.substr(count * header->stride)).size();
  return raw;
}

}  // namespace instep
