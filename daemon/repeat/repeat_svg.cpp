#include "daemon/repeat/repeat_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "daemon/report/number_text.h"
#include "daemon/report/svg_text.h"

namespace instep {
namespace {

using Eigen::Vector2d;

// The page is drawn in tenths of a millimetre.
constexpr double kWidth = 2100.0;
constexpr double kMargin = 150.0;
constexpr double kPlotLeft = 620.0;
constexpr double kPlotRight = 1560.0;
constexpr double kPlotMiddle = (kPlotLeft + kPlotRight) / 2.0;
constexpr double kRow = 110.0;
constexpr double kRowPadding = 22.0;
constexpr double kAxis = 90.0;
constexpr double kHeading = 130.0;
constexpr double kDot = 9.0;

constexpr const char* kStyle = R"(<style>
text { font-family: "Source Serif 4", Georgia, "DejaVu Serif", serif; fill: #3b3028; }
.title { font-size: 52px; }
.note { font-size: 25px; fill: #8a7b6c; }
.name { font-size: 30px; text-anchor: end; }
.figures { font-size: 26px; }
.tick { font-size: 25px; text-anchor: middle; fill: #8a7b6c; }
.grid { stroke: #e6dccd; stroke-width: 2; }
.zero { stroke: #8a7b6c; stroke-width: 3; }
.band { fill: #f3dfcb; }
.scan { fill: none; stroke: #2f5d7c; stroke-linecap: round; }
</style>
)";

/// The smallest step of 1, 2 or 5 times a power of ten of which four reach as far.
double axis_step(double reach) {
  const double quarter = std::max(reach, 1e-3) / 4.0;
  const double power = std::pow(10.0, std::floor(std::log10(quarter)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= quarter) return factor * power;
  }
  return 10.0 * power;
}

double reach_of(const std::vector<const RepeatedMeasure*>& measures) {
  double reach = 0.0;
  for (const auto* measure : measures) {
    const auto& figures = measure->figures;
    reach = std::max({reach, figures.greatest - figures.mean, figures.mean - figures.least});
  }
  return reach;
}

/// Rows of measures that share a unit, from `top` downwards.
class Panel {
 public:
  Panel(std::vector<const RepeatedMeasure*> measures, const char* unit, double top)
      : measures_(std::move(measures)),
        unit_(unit),
        top_(top),
        step_(axis_step(reach_of(measures_))) {}

  double bottom() const { return top_ + kRow * static_cast<double>(measures_.size()); }
  double end() const { return bottom() + kAxis; }

  std::string svg() const {
    std::string text = grid();
    double top = top_;
    for (const auto* measure : measures_) {
      text += row(*measure, top);
      top += kRow;
    }
    return text;
  }

 private:
  double place(double deviation) const {
    return kPlotMiddle + deviation / (4.0 * step_) * (kPlotRight - kPlotMiddle);
  }

  std::string grid() const {
    std::string text;
    for (int tick = -4; tick <= 4; ++tick) {
      const double x = place(tick * step_);
      text += svg::line({x, top_}, {x, bottom()}, tick == 0 ? "zero" : "grid");
      if (tick % 2 == 0) {
        text += svg::label({x, bottom() + 34.0}, "tick",
                           tick == 0 ? "0" : fmt::format("{:+.6g}", tick * step_));
      }
    }
    return text + svg::label({kPlotMiddle, bottom() + 68.0}, "tick",
                             fmt::format("deviation from the mean, {}", unit_));
  }

  std::string row(const RepeatedMeasure& measure, double top) const {
    const Repeatability& figures = measure.figures;
    const double band = figures.standard_deviation;
    const double inner = kRow - 2.0 * kRowPadding;
    const double middle = top + kRow / 2.0 + 9.0;
    std::string text = svg::polygon({{place(-band), top + kRowPadding},
                                     {place(band), top + kRowPadding},
                                     {place(band), top + kRow - kRowPadding},
                                     {place(-band), top + kRow - kRowPadding}},
                                    "band");
    std::vector<Vector2d> dots;
    for (std::size_t i = 0; i < figures.values.size(); ++i) {
      const double share =
          (static_cast<double>(i) + 0.5) / static_cast<double>(figures.values.size());
      dots.emplace_back(place(figures.values[i] - figures.mean), top + kRowPadding + share * inner);
    }
    text += svg::line({place(0.0), top}, {place(0.0), top + kRow}, "zero");
    text += svg::dots(dots, kDot, "scan");
    text += svg::label({kPlotLeft - 40.0, middle}, "name", as_words(measure.id));
    text += svg::label({kPlotRight + 40.0, middle - 16.0}, "figures",
                       fmt::format("mean {:.1f}, SD {:.2f}", figures.mean, band));
    return text + svg::label({kPlotRight + 40.0, middle + 18.0}, "figures",
                             fmt::format("range {:.2f}, |d| {:.2f}", figures.range(),
                                         figures.mean_absolute_difference));
  }

  std::vector<const RepeatedMeasure*> measures_;
  const char* unit_;
  double top_;
  double step_;
};

std::vector<const RepeatedMeasure*> of_unit(const RepeatedFoot& foot, bool angles) {
  std::vector<const RepeatedMeasure*> measures;
  for (const auto& measure : foot.measures) {
    if (measure.is_angle == angles) measures.push_back(&measure);
  }
  return measures;
}

/// Adds one foot below `y` and moves it on.
std::string foot_svg(const RepeatedFoot& foot, double& y) {
  std::string text =
      svg::label({kMargin, y + 60.0}, "title",
                 fmt::format("{} scans, {} foot", foot.scans.size(), foot.side)) +
      svg::label({kMargin, y + 100.0}, "note",
                 "each dot a scan, the first on top; band: one standard deviation; |d|: mean "
                 "absolute difference of two scans");
  y += kHeading;
  for (const bool angles : {false, true}) {
    const auto measures = of_unit(foot, angles);
    if (measures.empty()) continue;
    const Panel panel(measures, angles ? "degrees" : "mm", y);
    text += panel.svg();
    y = panel.end();
  }
  y += kMargin / 2.0;
  return text;
}

}  // namespace

std::string repeat_svg(const RepeatStudy& study) {
  double y = kMargin / 2.0;
  std::string feet;
  for (const auto& foot : study.feet) feet += foot_svg(foot, y);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}mm\" height=\"{:.0f}mm\" "
             "viewBox=\"0 0 {:.0f} {:.0f}\">\n",
             kWidth / 10.0, y / 10.0, kWidth, y) +
         kStyle + "<rect width=\"100%\" height=\"100%\" fill=\"#fdfaf5\"/>\n" + feet + "</svg>\n";
}

}  // namespace instep
