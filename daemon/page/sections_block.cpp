#include "daemon/page/sections_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "daemon/page/paper.h"
#include "daemon/report/number_text.h"
#include "daemon/report/section_drawing.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kCaption = 30.0;
constexpr double kAboveRow = 28.0;
/// The lines of text under a section.
constexpr double kBelowSection = 128.0;
constexpr double kBetween = 30.0;
/// What the text under a narrow section needs.
constexpr double kLeastWidth = 275.0;
constexpr SectionStyle kSectionStyle = {"section-tape", 4.0, 1.6};

double width_of(const DrawnSection& panel, double per_mm) {
  return std::max(kLeastWidth, per_mm * (panel.drawing.right - panel.drawing.left));
}

struct Row {
  std::vector<const DrawnSection*> panels;
  double width = 0.0;
  double height = 0.0;  ///< of the tallest section
};

std::vector<Row> rows_of(const std::vector<DrawnSection>& panels, double per_mm, double width) {
  std::vector<Row> rows;
  for (const auto& panel : panels) {
    const double wanted = width_of(panel, per_mm) + kBetween;
    if (rows.empty() || rows.back().width + wanted - kBetween > width) rows.emplace_back();
    Row& row = rows.back();
    row.panels.push_back(&panel);
    row.width += wanted;
    row.height = std::max(row.height, per_mm * panel.drawing.height);
  }
  return rows;
}

double height_of(const std::vector<Row>& rows) {
  double height = kCaption;
  for (const auto& row : rows) height += kAboveRow + row.height + kBelowSection;
  return height;
}

/// `middle` is that of the section on its base line.
std::string panel_svg(const DrawnSection& panel, const Vector2d& middle, double per_mm) {
  const SectionDrawing& drawing = panel.drawing;
  const Vector2d origin(middle.x() - per_mm * (drawing.left + drawing.right) / 2.0, middle.y());
  const double half = per_mm * (drawing.right - drawing.left) / 2.0 + 20.0;
  const Girth& girth = *panel.measure->girth;
  std::string text;
  if (!drawing.is_level) {
    text += svg::line(middle + Vector2d(-half, 6.0), middle + Vector2d(half, 6.0), "floor");
  }
  text += section_svg(drawing, origin, per_mm, kSectionStyle);
  text += svg::label(middle + Vector2d(0.0, 44.0), "section-name", as_words(panel.measure->id));
  text += svg::label(middle + Vector2d(0.0, 80.0), "section-number",
                     interval_text(panel.measure->value_mm, panel.measure->u95_mm));
  return text + svg::label(middle + Vector2d(0.0, 110.0), "section-note",
                           "along the skin " + tenths(girth.contact_mm));
}

}  // namespace

svg::Block sections_block(const FootScan& foot, const MeasureSet& measures, const Vector2d& corner,
                          double width, double lowest) {
  const auto panels = draw_sections(foot, measures);
  if (panels.empty()) return {{}, corner.y()};
  double scale = paper::kScales.back();
  std::vector<Row> rows;
  for (const double candidate : paper::kScales) {
    scale = candidate;
    rows = rows_of(panels, paper::per_foot_mm(scale), width);
    if (corner.y() + height_of(rows) <= lowest) break;
  }
  const double per_mm = paper::per_foot_mm(scale);
  double y = corner.y() + kCaption;
  std::string text = svg::label(
      {corner.x(), y}, "caption",
      fmt::format("sections with the medial side on the left, 1 : {:g}; tape orange, points of the "
                  "scan blue",
                  scale));
  for (const auto& row : rows) {
    y += kAboveRow + row.height;
    const double apart = (width - row.width + kBetween) / static_cast<double>(row.panels.size());
    double left = corner.x() + apart / 2.0;
    for (const DrawnSection* panel : row.panels) {
      const double panel_width = width_of(*panel, per_mm);
      text += panel_svg(*panel, {left + panel_width / 2.0, y}, per_mm);
      left += panel_width + kBetween + apart;
    }
    y += kBelowSection;
  }
  return {text, y};
}

}  // namespace instep
