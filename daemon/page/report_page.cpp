#include "daemon/page/report_page.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

#include "daemon/build_facts.h"
#include "daemon/page/numbers_block.h"
#include "daemon/page/paper.h"
#include "daemon/page/sections_block.h"
#include "daemon/page/views_block.h"
#include "daemon/report/number_text.h"
#include "daemon/report/svg_text.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kBelowHeader = 56.0;
constexpr double kOriginLetters = 26.0;
constexpr double kOriginLine = 36.0;
constexpr double kViewsWidth = 1150.0;
constexpr double kNumbersWidth = 610.0;
constexpr double kRight = paper::kWidth - paper::kMargin;
constexpr double kFooter = paper::kHeight - 110.0;
constexpr double kLowest = kFooter - 70.0;
constexpr double kRulerMm = 50.0;
constexpr double kBetweenBlocks = 40.0;
/// What the sections need when they are smallest.
constexpr double kLeastSections = 400.0;
/// The most that is kept below the sections for what is to be said in words.
constexpr double kMostNotes = 360.0;

constexpr const char* kStyle = R"(<style>
text { font-family: "Source Serif 4", Georgia, "DejaVu Serif", serif; fill: #2f261f; font-size: 26px; }
.title { font-size: 74px; }
.origin, .caption, .caption-end, .note, .legend, .section-note, .footer { fill: #6f6153; font-size: 24px; }
.origin { font-size: 26px; }
.caption { font-style: italic; font-size: 26px; }
.caption-end { font-style: italic; text-anchor: end; }
.row { font-size: 28px; }
.value { font-size: 28px; font-weight: bold; text-anchor: end; }
.other { font-size: 25px; fill: #6f6153; text-anchor: end; }
.length { font-size: 28px; font-weight: bold; text-anchor: middle; }
.tape-name { font-size: 25px; fill: #9a5312; text-anchor: middle; }
.tape-number { font-size: 27px; font-weight: bold; text-anchor: middle; }
.section-name { font-size: 29px; text-anchor: middle; }
.section-number { font-size: 34px; font-weight: bold; text-anchor: middle; }
.section-note { text-anchor: middle; }
.legend { font-size: 25px; }
.mark-number { font-size: 24px; font-weight: bold; text-anchor: middle; fill: #1f4f70;
  paint-order: stroke; stroke: #ffffff; stroke-width: 6; }
.mark-line { stroke: #1f4f70; stroke-width: 1.6; }
.mark { fill: none; stroke: #1f4f70; stroke-linecap: round; }
.body { fill: #fbf3ea; fill-rule: evenodd; stroke: #8f7965; stroke-width: 3; stroke-linejoin: round; }
.relief { fill: none; stroke: #a58a72; stroke-linecap: round; }
.tape { fill: none; stroke: #d9741f; stroke-width: 8; stroke-linecap: round; }
.tape-behind { fill: none; stroke: #d9741f; stroke-width: 2.5; stroke-dasharray: 9 7; }
.leader { fill: none; stroke: #d9741f; stroke-width: 1.8; }
.skin { fill: #f6e6d6; stroke: #6b4f3b; stroke-width: 3; stroke-linejoin: round; }
.section-tape { fill: none; stroke: #d9741f; stroke-width: 11; stroke-linejoin: round; }
.seen, .platform { fill: none; stroke-linecap: round; }
.seen { stroke: #1f4f70; }
.platform { stroke: #b3a392; }
.rule, .table-head { stroke: #2f261f; stroke-width: 3; }
.table-head { stroke-width: 2.5; }
.table-line { stroke: #ddd0c1; stroke-width: 2; }
.floor { stroke: #b9a892; stroke-width: 2.5; }
</style>
)";

std::string origin_text(const ScanRecord& record, const std::string& origin) {
  std::string text = origin;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : " · ") + part; };
  if (!record.id.empty()) {
    add(fmt::format("scan {}", record.id));
    add("station " + record.station);
    add(fmt::format("{:%Y-%m-%d %H:%M} UTC",
                    fmt::gmtime(std::chrono::system_clock::to_time_t(record.time))));
  }
  if (record.simulated) add("simulated");
  if (record.foot.side_confidence < 1.0) {
    add("side as the scan tells, " + at_least_percent(record.foot.side_confidence) + " sure");
  }
  return text;
}

svg::Block header(const ScanRecord& record, const std::string& origin) {
  std::string text = svg::label({paper::kMargin, 190.0}, "title",
                                record.foot.side == Side::kLeft ? "Left foot" : "Right foot");
  double y = 238.0 - kOriginLine;
  for (const auto& line :
       paper::wrapped(origin_text(record, origin), kRight - paper::kMargin, kOriginLetters)) {
    y += kOriginLine;
    text += svg::label({paper::kMargin, y}, "origin", line);
  }
  const double rule = y + 24.0;
  return {text + svg::line({paper::kMargin, rule}, {kRight, rule}, "rule"), rule};
}

/// The ruler is as long as it says if the page was printed at its own size.
std::string footer() {
  const Vector2d from(paper::kMargin, kFooter);
  const Vector2d to(paper::kMargin + paper::kPerMm * kRulerMm, kFooter);
  std::string text = svg::measuring_line(from, to, 12.0, "rule");
  text += svg::label(to + Vector2d(24.0, 9.0), "footer",
                     fmt::format("{:.0f} mm on paper if printed at 100 %. Lengths in mm; ± is half "
                                 "of the 95 % interval. Sizes are guidance.",
                                 kRulerMm));
  return text + svg::label({paper::kMargin, kFooter + 50.0}, "footer",
                           fmt::format("Instep {}. The definition of each measure is in "
                                       "result.json, or printed by instep measure.",
                                       program_version()));
}

}  // namespace

std::string report_page(const ScanRecord& record, const std::string& origin) {
  std::string page = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}mm\" height=\"{:.0f}mm\" "
      "viewBox=\"0 0 {:.0f} {:.0f}\">\n",
      paper::kWidth / paper::kPerMm, paper::kHeight / paper::kPerMm, paper::kWidth, paper::kHeight);
  page += kStyle;
  page += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  const auto head = header(record, origin);
  page += head.svg + footer();
  const double body_top = head.bottom + kBelowHeader;
  const double width = kRight - paper::kMargin;
  const double notes_top =
      kLowest - kBetweenBlocks / 2.0 - std::min(kMostNotes, notes_height(record, width));
  const auto views =
      views_block(record.foot, record.measures, {paper::kMargin, body_top}, kViewsWidth);
  const auto numbers = numbers_block(record, {kRight - kNumbersWidth, body_top}, kNumbersWidth,
                                     notes_top - kLeastSections - kBetweenBlocks);
  const double sections_top = std::max(views.bottom, numbers.bottom) + kBetweenBlocks;
  const auto sections = sections_block(record.foot, record.measures, {paper::kMargin, sections_top},
                                       width, notes_top);
  const auto notes =
      notes_block(record, {paper::kMargin, sections.bottom + kBetweenBlocks / 2.0}, width, kLowest);
  return page + views.svg + numbers.svg + sections.svg + notes.svg + "</svg>\n";
}

}  // namespace instep
