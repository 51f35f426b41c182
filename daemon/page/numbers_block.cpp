#include "daemon/page/numbers_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "daemon/page/paper.h"
#include "daemon/report/number_text.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kCaption = 30.0;
constexpr double kRow = 50.0;
constexpr double kOtherFootWidth = 84.0;
constexpr double kSizeRow = 40.0;
constexpr double kLetters = 28.0;
/// Bold letters of that size are as wide as plain ones of this.
constexpr double kBoldLetters = 30.0;
constexpr double kNoteLetters = 24.0;
constexpr double kTextLine = 32.0;
constexpr double kNoteSpace = 4.0;

/// A table that grows downwards.
class Table {
 public:
  Table(const Vector2d& corner, double width)
      : left_(corner.x()), right_(corner.x() + width), y_(corner.y()) {}

  void caption(const std::string& name, const std::string& at_right = {}) {
    y_ += kCaption;
    svg_ += svg::label({left_, y_}, "caption", name) +
            svg::label({right_, y_}, "caption-end", at_right) +
            svg::line({left_, y_ + 12.0}, {right_, y_ + 12.0}, "table-head");
    y_ += 12.0;
  }

  /// The choice of definitions is not empty if it is not the usual one: it stands behind the name,
  /// or below it where the value leaves no room. `other` is what the other foot has more, if
  /// `has_other`; without a `value`, none was measured.
  void measure(const std::string& name, const std::string& choice, const std::string& value,
               const std::string& other, bool has_other) {
    y_ += kRow;
    const double value_end = right_ - (has_other ? kOtherFootWidth : 0.0);
    const std::string said = value.empty() ? "not measured" : value;
    const std::string in_full = choice.empty() ? name : name + " (" + choice + ")";
    const bool has_room = choice.empty() || fit_beside(in_full, said, value_end);
    svg_ += svg::label({left_, y_ - 14.0}, "row", has_room ? in_full : name) +
            svg::label({value_end, y_ - 14.0}, value.empty() ? "other" : "value", said) +
            svg::label({right_, y_ - 14.0}, "other", other);
    if (!has_room) {
      y_ += kTextLine;
      svg_ += svg::label({left_, y_ - 14.0}, "note", "(" + choice + ")");
    }
    svg_ += svg::line({left_, y_}, {right_, y_}, "table-line");
  }

  /// The value stands beside the name's last line, or below it where both leave no room.
  void size(const std::string& name, const std::string& value) {
    y_ += kSizeRow - kTextLine;
    const std::string last = lines(name, left_, "row", kLetters);
    if (fit_beside(last, value, right_)) {
      svg_ += svg::label({right_, y_}, "value", value);
    } else {
      lines(value, right_, "value", kBoldLetters);
    }
  }

  void line(const std::string& text) { lines(text, left_, "note", kNoteLetters); }

  void space(double height) { y_ += height; }

  double bottom() const { return y_; }
  svg::Block block() const { return {svg_, y_}; }

 private:
  /// Adds as many lines as the text takes, and gives back the last one.
  std::string lines(const std::string& text, double x, const char* style, double letters) {
    std::string last;
    for (const auto& part : paper::wrapped(text, right_ - left_, letters)) {
      y_ += kTextLine;
      svg_ += svg::label({x, y_}, style, part);
      last = part;
    }
    return last;
  }

  bool fit_beside(const std::string& name, const std::string& value, double value_end) const {
    return paper::text_width(name + " ", kLetters) + paper::text_width(value, kBoldLetters) <=
           value_end - left_;
  }

  double left_;
  double right_;
  double y_;
  std::string svg_;
};

/// Adds to the table what does not reach below `lowest`, and says how much is left out.
template <typename Item, typename Add>
void add_while_there_is_room(const std::vector<Item>& items, double lowest, Table& table,
                             const Add& add) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    Table longer = table;
    add(longer, items[i]);
    const bool is_last = i + 1 == items.size();
    if (longer.bottom() + (is_last ? 0.0 : kTextLine) > lowest) {
      return table.line(fmt::format("and {} more, in result.json or printed", items.size() - i));
    }
    table = std::move(longer);
  }
}

std::string half_sizes(double size) {
  return fmt::format("{:g}", size);
}

std::string difference_text(const ScanRecord& record, const std::string& id) {
  const MeasurePair* both = record.pair ? record.pair->feet.find(id) : nullptr;
  if (both == nullptr) return {};
  const double more =
      record.foot.side == Side::kRight ? -both->difference_mm() : both->difference_mm();
  return std::abs(more) < 0.05 ? "0.0" : fmt::format("{:+.1f}", more);
}

void add_measures(const ScanRecord& record, Table& table) {
  const bool has_other = record.pair.has_value();
  const char* other = record.foot.side == Side::kLeft ? "right" : "left";
  const auto choice_of = [&](const std::string& id) {
    return as_words(own_choice(id, record.foot.rules));
  };
  table.caption("Measures in mm, ± 95 %", has_other ? other : "");
  for (const auto& measure : record.measures.measures) {
    table.measure(as_words(measure.id), choice_of(measure.id),
                  interval_text(measure.value(), measure.u95()) + (measure.value_deg ? "°" : ""),
                  difference_text(record, measure.id), has_other);
  }
  for (const auto& withheld : record.measures.withheld) {
    table.measure(as_words(withheld.id), choice_of(withheld.id), "", "", has_other);
  }
}

std::string length_and_width(const ShoeSizes& sizes) {
  return sizes.mondopoint_width_mm
             ? fmt::format("{:.0f}/{:.0f}", *sizes.mondopoint_mm, *sizes.mondopoint_width_mm)
             : fmt::format("{:.0f}", *sizes.mondopoint_mm);
}

void add_sizes(const ShoeSizes& sizes, bool of_both, double lowest, Table& table) {
  table.caption(of_both ? "Size guide for the larger of each measure" : "Size guide");
  table.space(6.0);
  if (sizes.mondopoint_mm) table.size("Mondopoint", length_and_width(sizes));
  if (sizes.eu) table.size("EU", half_sizes(sizes.eu->marked));
  if (sizes.uk) table.size("UK", half_sizes(sizes.uk->marked));
  if (sizes.us_men) table.size("US men (Brannock)", half_sizes(sizes.us_men->marked));
  if (sizes.us_women) table.size("US women (Brannock)", half_sizes(sizes.us_women->marked));
  if (sizes.jis_men) table.size("JIS S 5037 men", *sizes.jis_men);
  if (sizes.jis_women) table.size("JIS S 5037 women", *sizes.jis_women);
  for (const auto& note : sizes.notes) table.line(note);
  add_while_there_is_room(sizes.shop, lowest, table, [](Table& longer, const ShopChoice& choice) {
    longer.size(choice.table, choice.size.value_or("none"));
    if (!choice.note.empty()) longer.line(choice.note);
  });
}

/// Whatever doubts several measures alike is said once.
std::vector<std::string> notes_of(const ScanRecord& record) {
  std::vector<std::string> notes;
  for (const auto& withheld : record.measures.withheld) {
    notes.push_back(as_words(withheld.id) + " not measured: " + withheld.reason);
  }
  notes.insert(notes.end(), record.warnings.begin(), record.warnings.end());
  notes.insert(notes.end(), record.foot.warnings.begin(), record.foot.warnings.end());
  std::vector<std::pair<std::string, std::string>> doubts;  // warning, and the measures it is about
  for (const auto& measure : record.measures.measures) {
    for (const auto& warning : measure.warnings) {
      const auto known = std::find_if(doubts.begin(), doubts.end(),
                                      [&](const auto& doubt) { return doubt.first == warning; });
      if (known == doubts.end()) {
        doubts.emplace_back(warning, as_words(measure.id));
      } else {
        known->second += ", " + as_words(measure.id);
      }
    }
  }
  for (const auto& [warning, ids] : doubts) notes.push_back(ids + ": " + warning);
  return notes;
}

constexpr const char* kNotesCaption = "Not measured, and to be doubted";

}  // namespace

double notes_height(const ScanRecord& record, double width) {
  const auto notes = notes_of(record);
  if (notes.empty()) return 0.0;
  Table table({0.0, 0.0}, width);
  table.caption(kNotesCaption);
  for (const auto& note : notes) table.line(note);
  return table.bottom() + kNoteSpace;
}

svg::Block numbers_block(const ScanRecord& record, const Vector2d& corner, double width,
                         double lowest) {
  Table table(corner, width);
  add_measures(record, table);
  table.space(34.0);
  add_sizes(record.pair ? record.pair->sizes : record.sizes, record.pair.has_value(), lowest,
            table);
  return table.block();
}

svg::Block notes_block(const ScanRecord& record, const Vector2d& corner, double width,
                       double lowest) {
  const auto notes = notes_of(record);
  if (notes.empty()) return {{}, corner.y()};
  Table table(corner, width);
  table.caption(kNotesCaption);
  table.space(kNoteSpace);
  add_while_there_is_room(notes, lowest, table,
                          [](Table& longer, const std::string& note) { longer.line(note); });
  return table.block();
}

}  // namespace instep
