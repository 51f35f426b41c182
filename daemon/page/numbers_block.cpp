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
constexpr double kNoteLetters = 24.0;
constexpr double kNoteLine = 32.0;
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
    const bool has_room =
        choice.empty() || paper::text_width(in_full + " " + said, kLetters) <= value_end - left_;
    svg_ += svg::label({left_, y_ - 14.0}, "row", has_room ? in_full : name) +
            svg::label({value_end, y_ - 14.0}, value.empty() ? "other" : "value", said) +
            svg::label({right_, y_ - 14.0}, "other", other);
    if (!has_room) {
      y_ += kNoteLine;
      svg_ += svg::label({left_, y_ - 14.0}, "note", "(" + choice + ")");
    }
    svg_ += svg::line({left_, y_}, {right_, y_}, "table-line");
  }

  void size(const std::string& system, const std::string& value) {
    y_ += kSizeRow;
    svg_ += svg::label({left_, y_}, "row", system) + svg::label({right_, y_}, "value", value);
  }

  void line(const std::string& text) {
    for (const auto& part : paper::wrapped(text, right_ - left_, kNoteLetters)) {
      y_ += kNoteLine;
      svg_ += svg::label({left_, y_}, "note", part);
    }
  }

  void space(double height) { y_ += height; }

  double bottom() const { return y_; }
  svg::Block block() const { return {svg_, y_}; }

 private:
  double left_;
  double right_;
  double y_;
  std::string svg_;
};

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

void add_sizes(const ShoeSizes& sizes, bool of_both, Table& table) {
  table.caption(of_both ? "Size guide for the larger foot" : "Size guide");
  table.space(6.0);
  if (sizes.mondopoint_mm) table.size("Mondopoint", length_and_width(sizes));
  if (sizes.eu) table.size("EU", half_sizes(sizes.eu->marked));
  if (sizes.uk) table.size("UK", half_sizes(sizes.uk->marked));
  if (sizes.us_men) table.size("US men (Brannock)", half_sizes(sizes.us_men->marked));
  if (sizes.us_women) table.size("US women (Brannock)", half_sizes(sizes.us_women->marked));
  if (sizes.jis_men) table.size("JIS S 5037 men", *sizes.jis_men);
  if (sizes.jis_women) table.size("JIS S 5037 women", *sizes.jis_women);
  for (const auto& choice : sizes.shop) {
    table.size(choice.table, choice.size.value_or("none"));
    if (!choice.note.empty()) table.line(choice.note);
  }
  for (const auto& note : sizes.notes) table.line(note);
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

svg::Block numbers_block(const ScanRecord& record, const Vector2d& corner, double width) {
  Table table(corner, width);
  add_measures(record, table);
  table.space(34.0);
  add_sizes(record.pair ? record.pair->sizes : record.sizes, record.pair.has_value(), table);
  return table.block();
}

svg::Block notes_block(const ScanRecord& record, const Vector2d& corner, double width,
                       double lowest) {
  const auto notes = notes_of(record);
  if (notes.empty()) return {{}, corner.y()};
  Table table(corner, width);
  table.caption(kNotesCaption);
  table.space(kNoteSpace);
  for (std::size_t i = 0; i < notes.size(); ++i) {
    const auto lines = paper::wrapped(notes[i], width, kNoteLetters).size();
    const bool is_last = i + 1 == notes.size();
    const double room = lowest - table.bottom() - (is_last ? 0.0 : kNoteLine);
    if (static_cast<double>(lines) * kNoteLine > room) {
      table.line(fmt::format("and {} more: see result.json", notes.size() - i));
      break;
    }
    table.line(notes[i]);
  }
  return table.block();
}

}  // namespace instep
