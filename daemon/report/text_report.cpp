#include "daemon/report/text_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "daemon/report/number_text.h"
#include "daemon/report/sizes_report.h"

namespace instep {
namespace {

std::string interval_column(const std::optional<double>& u95) {
  return u95 ? "± " + interval_tenths(*u95) : std::string();
}

std::size_t widest_name(const MeasureSet& measures) {
  std::size_t width = 0;
  for (const auto& measure : measures.measures) width = std::max(width, measure.id.size());
  for (const auto& withheld : measures.withheld) width = std::max(width, withheld.id.size());
  return width;
}

void add_warnings(std::string& text, const FootScan& foot, const MeasureSet& measures) {
  for (const auto& warning : foot.warnings) text += fmt::format("  ! {}\n", warning);
  for (const auto& measure : measures.measures) {
    for (const auto& warning : measure.warnings) {
      text += fmt::format("  ! {}: {}\n", as_words(measure.id), warning);
    }
  }
}

}  // namespace

std::string foot_text(const FootScan& foot, const MeasureSet& measures, const ShoeSizes& sizes) {
  std::string text = fmt::format("{} foot", foot.side == Side::kLeft ? "Left" : "Right");
  if (foot.side_confidence < 1.0) {
    text += fmt::format(" (as the scan tells, {} sure)", at_least_percent(foot.side_confidence));
  }
  text += "\n\n";
  const std::size_t width = widest_name(measures);
  for (const auto& measure : measures.measures) {
    std::string line = fmt::format("  {:<{}}  {:>7} {}  {:<7}", as_words(measure.id), width,
                                   tenths(measure.value()), measure.value_deg ? "° " : "mm",
                                   interval_column(measure.u95()));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  for (const auto& withheld : measures.withheld) {
    text +=
        fmt::format("  {:<{}}        -     {}\n", as_words(withheld.id), width, withheld.reason);
  }
  if (const auto guide = sizes_text(sizes_json(sizes)); !guide.empty()) text += "\n" + guide;
  std::string warnings;
  add_warnings(warnings, foot, measures);
  return warnings.empty() ? text : text + "\n" + warnings;
}

std::string girth_text(const std::string& method, const Girth& girth) {
  std::string text = fmt::format("stretched    {} mm\ncontact      {} mm\n",
                                 interval_text(girth.stretched_mm, girth.stretched_u95_mm),
                                 interval_text(girth.contact_mm, girth.contact_u95_mm));
  text += fmt::format("method       {}", method);
  if (girth.band_points > 0) {
    text += fmt::format(", {} of {} points", girth.band_points, girth.points);
  }
  if (girth.sigma_mm > 0.0) text += fmt::format(", noise {:.2f} mm", girth.sigma_mm);
  text += "\n";
  text += fmt::format("largest gap  {} mm\n", tenths(girth.largest_gap_mm));
  for (const auto& warning : girth.warnings) text += fmt::format("! {}\n", warning);
  return text;
}

}  // namespace instep
