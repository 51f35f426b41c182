#include "core/foot/shoe_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/foot/standing/shoe_last.h"
#include "core/in_millimetres.h"

namespace instep {
namespace {

constexpr double kMondopointStepMm = 5.0;
constexpr double kParisPointMm = 20.0 / 3.0;
constexpr double kThirdOfAnInchMm = 25.4 / 3.0;
constexpr double kUkZero = 25.0;
constexpr double kUsMenZero = 22.0;
constexpr double kUsWomenZero = 21.0;
/// A foot that is shorter by less than this, or than a step of the table, still takes its smallest
/// size.
constexpr double kLeastShopStepMm = 10.0;

/// One table of JIS S 5037. The girth of letter A at the shortest length; it grows by 3 mm with
/// each 5 mm of length, and by 6 mm with each letter.
struct JisTable {
  double shortest_mm;
  double longest_mm;
  double least_girth_mm;
  std::span<const char* const> letters;
};
constexpr double kJisGirthOverLength = 3.0 / 5.0;
constexpr double kJisLetterMm = 6.0;
constexpr std::array kJisLetters = {"A", "B", "C", "D", "E", "EE", "EEE", "EEEE", "F", "G"};
constexpr JisTable kJisMen{200.0, 300.0, 189.0, kJisLetters};
constexpr JisTable kJisWomen{195.0, 270.0, 183.0, std::span(kJisLetters).first(9)};

std::optional<double> value_of(const MeasureSet& measures, const char* id) {
  const Measure* measure = measures.find(id);
  if (measure == nullptr || !std::isfinite(measure->value_mm)) return {};
  return measure->value_mm > 0.0 ? std::optional(measure->value_mm) : std::nullopt;
}

std::optional<double> larger(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::max(*a, *b) : (a ? a : b);
}

/// Scales begin at 1; what is below would be a child's size, which counts otherwise.
std::optional<MarkedSize> marked(double exact) {
  const double nearest_half = std::round(2.0 * exact) / 2.0;
  if (nearest_half < 1.0) return {};
  return MarkedSize{exact, nearest_half};
}

std::string centimetres(double mm) {
  const auto tenths = std::lround(mm);
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
}

std::optional<std::string> jis_size(const JisTable& table, double length_mm, double girth_mm) {
  const double length = kMondopointStepMm * std::round(length_mm / kMondopointStepMm);
  if (length < table.shortest_mm || length > table.longest_mm) return {};
  const double narrowest =
      table.least_girth_mm + kJisGirthOverLength * (length - table.shortest_mm);
  const double letter = std::floor((girth_mm - narrowest) / kJisLetterMm + 0.5);
  if (letter < 0.0 || letter >= static_cast<double>(table.letters.size())) return {};
  return centimetres(length) + " " + table.letters[static_cast<std::size_t>(letter)];
}

void add_widths(const SizedFoot& foot, ShoeSizes& sizes) {
  if (!foot.ball_girth_mm) {
    sizes.notes.emplace_back("the ball girth is missing: there is no width fitting");
    return;
  }
  sizes.jis_men = jis_size(kJisMen, *foot.length_mm, *foot.ball_girth_mm);
  sizes.jis_women = jis_size(kJisWomen, *foot.length_mm, *foot.ball_girth_mm);
  if (!sizes.jis_men && !sizes.jis_women) {
    sizes.notes.emplace_back("the foot is outside the tables of JIS S 5037");
  }
}

bool takes(const ShopSize& size, const SizedFoot& foot) {
  const bool long_enough = *foot.length_mm <= size.longest_foot_mm;
  const bool wide_enough = !foot.ball_girth_mm || !size.largest_ball_girth_mm ||
                           *foot.ball_girth_mm <= *size.largest_ball_girth_mm;
  return long_enough && wide_enough;
}

/// By how much longer a foot the size after the smallest takes.
double first_step_mm(const ShopTable& table) {
  const double smallest = table.sizes.front().longest_foot_mm;
  for (const auto& size : table.sizes) {
    if (size.longest_foot_mm > smallest) return size.longest_foot_mm - smallest;
  }
  return 0.0;
}

/// Where a foot is shorter by more than a step: the table does not say how short a foot its
/// smallest size is for.
bool may_be_too_long(const ShopTable& table, const ShopSize& size, double foot_mm) {
  const double smallest = table.sizes.front().longest_foot_mm;
  const double step = std::max(first_step_mm(table), kLeastShopStepMm);
  return size.longest_foot_mm == smallest && foot_mm < smallest - step;
}

ShopChoice choose(const ShopTable& table, const SizedFoot& foot) {
  ShopChoice choice;
  choice.table = table.name;
  const auto row = std::find_if(table.sizes.begin(), table.sizes.end(),
                                [&](const ShopSize& size) { return takes(size, foot); });
  if (row == table.sizes.end()) {
    choice.note = "no size of the table is long and wide enough";
    return choice;
  }
  choice.size = row->size;
  if (row->largest_ball_girth_mm && !foot.ball_girth_mm) {
    choice.note = "by the length alone: the ball girth is missing";
  }
  if (may_be_too_long(table, *row, *foot.length_mm)) {
    choice.note += (choice.note.empty() ? "" : "; ") +
                   std::string("may be too long: it takes a foot ") +
                   in_millimetres(row->longest_foot_mm - *foot.length_mm) +
                   " longer, and the table has none smaller";
  }
  return choice;
}

}  // namespace

SizedFoot sized_foot(const MeasureSet& measures) {
  const Measure* length = measures.find("foot_length");
  const bool tells_size = length == nullptr || !length->u95_mm || *length->u95_mm <= kParisPointMm;
  return {tells_size ? value_of(measures, "foot_length") : std::nullopt,
          value_of(measures, "ball_girth"), value_of(measures, "foot_breadth")};
}

SizedFoot larger_of(const SizedFoot& one, const SizedFoot& other) {
  return {larger(one.length_mm, other.length_mm), larger(one.ball_girth_mm, other.ball_girth_mm),
          larger(one.breadth_mm, other.breadth_mm)};
}

std::vector<std::string> notes_of_one_foot(const SizedFoot& left, const SizedFoot& right) {
  std::vector<std::string> notes;
  const auto compare = [&](const char* what, const std::optional<double> SizedFoot::*measure) {
    const bool has_left = (left.*measure).has_value();
    if (has_left == (right.*measure).has_value()) return;
    notes.push_back(std::string("by the ") + what + " of the " + (has_left ? "left" : "right") +
                    " foot alone: that of the other one is missing and may be more; scan it again");
  };
  compare("length", &SizedFoot::length_mm);
  compare("ball girth", &SizedFoot::ball_girth_mm);
  compare("breadth", &SizedFoot::breadth_mm);
  return notes;
}

ShoeSizes shoe_sizes(const SizedFoot& foot, const SizeRules& rules) {
  ShoeSizes sizes;
  sizes.foot = foot;
  sizes.allowance_mm = rules.allowance_mm;
  if (!foot.length_mm) {
    sizes.notes.emplace_back(
        "the foot length is missing, or told to no better than a size: there is none without it");
    return sizes;
  }
  const double foot_mm = *foot.length_mm;
  const double last_mm = foot_mm + rules.allowance_mm;
  sizes.mondopoint_mm = kMondopointStepMm * std::round(foot_mm / kMondopointStepMm);
  if (foot.breadth_mm) sizes.mondopoint_width_mm = std::round(*foot.breadth_mm);
  sizes.eu = marked(last_mm / kParisPointMm);
  sizes.uk = marked(last_mm / kThirdOfAnInchMm - kUkZero);
  sizes.us_men = marked(foot_mm / kThirdOfAnInchMm - kUsMenZero);
  sizes.us_women = marked(foot_mm / kThirdOfAnInchMm - kUsWomenZero);
  add_widths(foot, sizes);
  for (const auto& table : rules.shop_tables) sizes.shop.push_back(choose(table, foot));
  return sizes;
}

ShoeSizes shoe_sizes(const FootScan& foot, const MeasureSet& measures, const SizeRules& rules) {
  return shoe_sizes(foot, sized_foot(measures), rules);
}

ShoeSizes shoe_sizes(const FootScan& foot, const SizedFoot& sized, const SizeRules& rules) {
  if (!is_shoe_last(foot)) {
    ShoeSizes sizes = shoe_sizes(sized, rules);
    if (foot.rules != MeasuringRules{}) {
      sizes.notes.emplace_back("the scales are made for the usual definitions of measures");
    }
    return sizes;
  }
  ShoeSizes none;
  none.allowance_mm = rules.allowance_mm;
  none.notes.emplace_back("this is a shoe last: sizes are told from feet");
  return none;
}

}  // namespace instep
