#include "daemon/report/sections_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "daemon/report/number_text.h"
#include "daemon/report/plan_drawing.h"
#include "daemon/report/section_drawing.h"
#include "daemon/report/svg_text.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kMarginPx = 48.0;
constexpr double kLeastPageWidthPx = 1060.0;
constexpr double kPixelsPerMm = 3.0;
constexpr double kBetweenPx = 56.0;
constexpr double kPlanTopPx = 120.0;
constexpr double kLeastPlanHeightPx = 230.0;
/// What the length takes below the foot from above.
constexpr double kLengthHeightPx = 60.0;
constexpr double kTableWidthPx = 364.0;
constexpr double kBesideTablePx = 40.0;
constexpr double kAboveSectionsPx = 53.0;
constexpr double kBelowSectionsPx = 150.0;
constexpr double kRulerMm = 50.0;
constexpr SectionStyle kSectionStyle = {"tape", 1.5, 1.3};

constexpr const char* kStyle = R"(<style>
text { font-family: "Source Serif 4", Georgia, "DejaVu Serif", serif; fill: #3b3028; }
.title { font-size: 30px; }
.note { font-size: 13px; fill: #8a7b6c; }
.row { font-size: 15px; }
.value { font-size: 15px; text-anchor: end; font-weight: bold; }
.name { font-size: 13px; text-anchor: middle; fill: #8a4b20;
  paint-order: stroke; stroke: #fdfaf5; stroke-width: 4; }
.length { font-size: 15px; text-anchor: middle; font-weight: bold; }
.heading { font-size: 18px; text-anchor: middle; }
.number { font-size: 26px; text-anchor: middle; font-weight: bold; }
.middle { font-size: 13px; text-anchor: middle; fill: #8a7b6c; }
.doubt { font-size: 12px; fill: #a8552a; }
.side { font-size: 12px; fill: #8a7b6c; text-anchor: middle; font-style: italic; }
.skin { fill: #f3dfcb; stroke: #7a5a42; stroke-width: 1.4; stroke-linejoin: round; }
.tape { fill: none; stroke: #d9822b; stroke-width: 4; stroke-linejoin: round; }
.seen, .platform, .cloud, .mark { fill: none; stroke-linecap: round; }
.seen { stroke: #2f5d7c; opacity: 0.75; }
.platform { stroke: #b9aa9a; }
.cloud { stroke: #b79f88; }
.mark { stroke: #3b3028; }
.rule { stroke: #3b3028; stroke-width: 1.2; }
.floor { stroke: #cdbfae; stroke-width: 1.2; }
</style>
)";

double width_px(const DrawnSection& section) {
  return kPixelsPerMm * (section.drawing.right - section.drawing.left);
}

/// One section on its base line; `left` is where its leftmost point comes to lie.
std::string panel_svg(const DrawnSection& panel, double left, double base_line) {
  const SectionDrawing& drawing = panel.drawing;
  const Vector2d origin(left - kPixelsPerMm * drawing.left, base_line);
  const double middle = left + width_px(panel) / 2.0;
  const double top = base_line - kPixelsPerMm * drawing.height;
  const Girth& girth = *panel.measure->girth;
  std::string text;
  if (!drawing.is_level) {
    text += svg::line({left - 14.0, base_line + 3.0},
                      {left + width_px(panel) + 14.0, base_line + 3.0}, "floor");
  }
  text += section_svg(drawing, origin, kPixelsPerMm, kSectionStyle);
  text += svg::label({middle, top - 12.0}, "side", drawing.upper_end);
  text += svg::label({middle, base_line + 20.0}, "side", drawing.lower_end);
  text += svg::label({left + 10.0, base_line + 20.0}, "side", "medial");
  text += svg::label({left + width_px(panel) - 10.0, base_line + 20.0}, "side", "lateral");
  text += svg::label({middle, base_line + 52.0}, "heading", as_words(panel.measure->id));
  text += svg::label({middle, base_line + 82.0}, "number", measure_text(*panel.measure));
  text += svg::label({middle, base_line + 102.0}, "middle",
                     fmt::format("along the skin {} mm", tenths(girth.contact_mm)));
  return text;
}

std::string title(const FootScan& foot, double width) {
  return svg::label({kMarginPx, 62.0}, "title",
                    foot.side == Side::kLeft ? "Left foot" : "Right foot") +
         svg::label({kMarginPx, 86.0}, "note",
                    "stretched tape in orange, points of the scan in blue; all sections to one "
                    "scale, seen with the medial side on the left") +
         svg::line({kMarginPx, 100.0}, {width - kMarginPx, 100.0}, "floor");
}

/// All measures in a table beside the foot from above.
svg::Block table(const MeasureSet& measures, double left, double right) {
  std::string text;
  double y = kPlanTopPx + 24.0;
  double bottom = kPlanTopPx;
  for (const auto& measure : measures.measures) {
    text += svg::label({left, y}, "row", as_words(measure.id));
    text += svg::label({right, y}, "value", measure_text(measure));
    text += svg::line({left, y + 8.0}, {right, y + 8.0}, "floor");
    bottom = y + 8.0;
    y += 30.0;
  }
  for (const auto& withheld : measures.withheld) {
    text += svg::label({left, y}, "doubt", as_words(withheld.id) + ": not measured");
    bottom = y;
    y += 22.0;
  }
  return {text, bottom};
}

std::string ruler(double y) {
  const Vector2d from(kMarginPx, y);
  const Vector2d to(kMarginPx + kPixelsPerMm * kRulerMm, y);
  return svg::measuring_line(from, to, 4.0, "rule") +
         svg::label(to + Vector2d(10.0, 5.0), "note", fmt::format("{:.0f} mm", kRulerMm));
}

}  // namespace

std::string sections_svg(const FootScan& foot, const MeasureSet& measures) {
  const auto panels = draw_sections(foot, measures);
  double row_width = 0.0;
  double tallest = 0.0;
  for (const auto& panel : panels) {
    row_width += width_px(panel) + (row_width > 0.0 ? kBetweenPx : 0.0);
    tallest = std::max(tallest, kPixelsPerMm * panel.drawing.height);
  }
  const double width = std::max(kLeastPageWidthPx, row_width + 2.0 * kMarginPx);
  const double table_left = width - kMarginPx - kTableWidthPx;
  const auto numbers = table(measures, table_left, width - kMarginPx);
  // The foot is as tall as the table beside it.
  const double plan_height =
      std::max(kLeastPlanHeightPx, numbers.bottom - kPlanTopPx - kLengthHeightPx);
  const auto plan = plan_drawing(foot, measures, {kMarginPx, kPlanTopPx},
                                 {table_left - kBesideTablePx - kMarginPx, plan_height});
  const double base_line = std::max(plan.bottom, numbers.bottom) + kAboveSectionsPx + tallest;
  const double height = base_line + kBelowSectionsPx;

  std::string page = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n",
      width, height);
  page += kStyle;
  page += "<rect width=\"100%\" height=\"100%\" fill=\"#fdfaf5\"/>\n";
  page += title(foot, width);
  page += plan.svg + numbers.svg;
  double left = (width - row_width) / 2.0;
  for (const auto& panel : panels) {
    page += panel_svg(panel, left, base_line);
    left += width_px(panel) + kBetweenPx;
  }
  if (!panels.empty()) page += ruler(height - 24.0);
  return page + "</svg>\n";
}

}  // namespace instep
