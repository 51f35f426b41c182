#include "daemon/cloud_files/ply_body.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>

#include "daemon/cloud_files/raw_cloud.h"
#include "daemon/cloud_files/text_tokens.h"

namespace instep {
namespace {

/// A polygon with more corners is damage; a strip of triangles may be the whole mesh.
double longest_list(const PlyElement& element) {
  return element.name == "tristrips" ? static_cast<double>(kMostFilePoints) : 100000;
}

/// What to do with each property while walking through records one by one.
struct Plan {
  std::vector<double*> next;  ///< place of the next value, or nullptr
  std::vector<std::size_t> step;
  PlyLists* lists = nullptr;

  Plan(const PlyElement& element, const std::vector<PlyColumn>& columns, PlyLists* wanted_lists)
      : next(element.properties.size()), step(element.properties.size()), lists(wanted_lists) {
    for (const auto& column : columns) {
      next[column.property] = column.target.first;
      step[column.property] = column.target.step;
    }
  }

  bool wants_list(std::size_t property) const {
    return lists != nullptr && lists->property == property;
  }

  void take(std::size_t property, double value) {
    if (next[property] == nullptr) return;
    *next[property] = value;
    next[property] += step[property];
  }
};

bool is_list_length(double length, double longest) {
  return length >= 0 && length <= longest &&
         length == static_cast<double>(static_cast<std::uint32_t>(length));
}

class BinaryBody final : public PlyBody {
 public:
  BinaryBody(std::string_view rest, bool swapped, std::string file)
      : rest_(rest), swapped_(swapped), file_(std::move(file)) {}

  bool can_hold(const PlyElement& element) const override {
    return element.count <= rest_.size() / std::max<std::size_t>(least_bytes(element), 1);
  }

  Result<void> read(const PlyElement& element, const std::vector<PlyColumn>& columns,
                    PlyLists* lists) override {
    if (!can_hold(element)) return ends_early(element);
    const bool has_lists =
        std::any_of(element.properties.begin(), element.properties.end(),
                    [](const PlyProperty& p) { return p.count_type.has_value(); });
    if (has_lists) return walk(element, Plan(element, columns, lists));
    copy(element, columns);
    return {};
  }

  std::size_t unread_bytes() const override { return without_blanks_at_end(rest_).size(); }

 private:
  /// The size of a record whose lists are empty.
  static std::size_t least_bytes(const PlyElement& element) {
    std::size_t size = 0;
    for (const auto& property : element.properties) {
      size += size_of(property.count_type.value_or(property.type));
    }
    return size;
  }

  void copy(const PlyElement& element, const std::vector<PlyColumn>& columns) {
    const std::size_t stride = least_bytes(element);
    for (const auto& column : columns) {
      std::size_t offset = 0;
      for (std::size_t i = 0; i < column.property; ++i) {
        offset += size_of(element.properties[i].type);
      }
      copy_column(rest_.data() + offset, stride, element.count,
                  element.properties[column.property].type, swapped_, column.target);
    }
    rest_.remove_prefix(stride * element.count);
  }

  Result<void> walk(const PlyElement& element, Plan plan) {
    struct Loaders {
      ScalarLoader value, length;
      std::size_t value_size, length_size;
    };
    const double longest = longest_list(element);
    std::vector<Loaders> loaders;
    for (const auto& property : element.properties) {
      const auto count_type = property.count_type.value_or(ScalarType::kUint8);
      loaders.push_back({scalar_loader(property.type, swapped_),
                         scalar_loader(count_type, swapped_), size_of(property.type),
                         property.count_type ? size_of(count_type) : 0});
    }
    for (std::size_t record = 0; record < element.count; ++record) {
      for (std::size_t p = 0; p < loaders.size(); ++p) {
        const auto& loader = loaders[p];
        double length = 1;
        if (loader.length_size > 0) {
          if (rest_.size() < loader.length_size) return ends_early(element);
          length = loader.length(rest_.data());
          rest_.remove_prefix(loader.length_size);
          if (!is_list_length(length, longest)) return bad_length(element, record);
        }
        const auto items = static_cast<std::size_t>(length);
        if (rest_.size() / loader.value_size < items) return ends_early(element);
        if (loader.length_size == 0) {
          plan.take(p, loader.value(rest_.data()));
        } else if (plan.wants_list(p)) {
          plan.lists->lengths.push_back(static_cast<std::uint32_t>(items));
          for (std::size_t i = 0; i < items; ++i) {
            plan.lists->items.push_back(loader.value(rest_.data() + i * loader.value_size));
          }
        }
        rest_.remove_prefix(items * loader.value_size);
      }
    }
    return {};
  }

  tl::unexpected<Error> ends_early(const PlyElement& element) const {
    return damaged_file(
        file_, fmt::format("it ends before its {} records \"{}\" do", element.count, element.name));
  }
  tl::unexpected<Error> bad_length(const PlyElement& element, std::size_t record) const {
    return damaged_file(file_, fmt::format("record {} of \"{}\" has a list of absurd length",
                                           record, element.name));
  }

  std::string_view rest_;
  bool swapped_;
  std::string file_;
};

class AsciiBody final : public PlyBody {
 public:
  AsciiBody(std::string_view rest, std::string file) : rest_(rest), file_(std::move(file)) {}

  bool can_hold(const PlyElement& element) const override {
    // A value and what parts it from the next take two bytes, but for the very last.
    const std::size_t least = 2 * std::max<std::size_t>(element.properties.size(), 1);
    return element.count <= (rest_.size() + 1) / least;
  }

  Result<void> read(const PlyElement& element, const std::vector<PlyColumn>& columns,
                    PlyLists* lists) override {
    if (!can_hold(element)) return bad_record(element, element.count);
    if (auto rows = check_columns(element); !rows) return rows;
    Plan plan(element, columns, lists);
    const double longest = longest_list(element);
    for (std::size_t record = 0; record < element.count; ++record) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const auto first = number_in(take_word(rest_));
        if (!first) return bad_record(element, record);
        if (!element.properties[p].count_type) {
          plan.take(p, *first);
        } else if (!is_list_length(*first, longest) || !take_list(p, *first, plan)) {
          return bad_record(element, record);
        }
      }
    }
    return {};
  }

  std::size_t unread_bytes() const override { return without_blanks_at_end(rest_).size(); }

 private:
  /// A row that holds more than its header names would be read as another point.
  Result<void> check_columns(const PlyElement& element) const {
    const auto& properties = element.properties;
    const bool has_lists = std::any_of(properties.begin(), properties.end(),
                                       [](const auto& one) { return one.count_type.has_value(); });
    const std::size_t words = words_in_first_row(rest_);
    if (element.count == 0 || has_lists || words <= properties.size()) return {};
    return damaged_file(file_, fmt::format("its rows \"{}\" hold {} numbers, its header names {}",
                                           element.name, words, properties.size()));
  }

  bool take_list(std::size_t property, double length, Plan& plan) {
    if (plan.wants_list(property)) {
      plan.lists->lengths.push_back(static_cast<std::uint32_t>(length));
    }
    for (double i = 0; i < length; ++i) {
      const auto item = number_in(take_word(rest_));
      if (!item) return false;
      if (plan.wants_list(property)) plan.lists->items.push_back(*item);
    }
    return true;
  }

  tl::unexpected<Error> bad_record(const PlyElement& element, std::size_t record) const {
    return damaged_file(
        file_, fmt::format("its {} records \"{}\" are cut short or hold no numbers from {} on",
                           element.count, element.name, record));
  }

  std::string_view rest_;
  std::string file_;
};

}  // namespace

std::unique_ptr<PlyBody> open_ply_body(const PlyHeader& header, std::string_view bytes,
                                       const std::string& file) {
  const auto rest = bytes.substr(header.size_bytes);
  if (header.format == PlyFormat::kAscii) return std::make_unique<AsciiBody>(rest, file);
  const bool little = header.format == PlyFormat::kLittleEndian;
  const bool swapped = little != (std::endian::native == std::endian::little);
  return std::make_unique<BinaryBody>(rest, swapped, file);
}

}  // namespace instep
