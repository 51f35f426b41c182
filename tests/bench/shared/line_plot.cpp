#include "tests/bench/shared/line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "daemon/report/svg_text.h"

namespace instep::bench {
namespace {

using Eigen::Vector2d;

constexpr double kWidthPx = 760.0;
constexpr double kHeightPx = 430.0;
constexpr double kLeftPx = 76.0;
constexpr double kRightPx = 150.0;
constexpr double kTopPx = 66.0;
constexpr double kBottomPx = 56.0;
constexpr double kNameHeightPx = 17.0;

constexpr const char* kStyle = R"(<style>
text { font-family: "DejaVu Sans", Verdana, sans-serif; font-size: 13px; fill: #7d8590; }
.title { font-size: 17px; font-weight: bold; }
.middle { text-anchor: middle; }
.end { text-anchor: end; }
.grid { stroke: #7d8590; stroke-width: 1; opacity: 0.25; }
.frame { stroke: #7d8590; stroke-width: 1.2; }
.line { fill: none; stroke-width: 2.4; stroke-linejoin: round; }
.dots { fill: none; stroke-linecap: round; }
.dashed { stroke-dasharray: 6 5; stroke-width: 1.8; }
.c0 { stroke: #2f81f7; } .c1 { stroke: #db6d28; } .c2 { stroke: #2da44e; } .c3 { stroke: #a371f7; }
.c4 { stroke: #2f81f7; } .c5 { stroke: #d29922; }
.n0, .n4 { fill: #2f81f7; } .n1 { fill: #db6d28; } .n2 { fill: #2da44e; } .n3 { fill: #a371f7; }
.n5 { fill: #d29922; }
</style>
)";

/// An axis with the range of its data, mapped to pixels.
class Ruler {
 public:
  Ruler(const LinePlot& plot, const PlotAxis& axis, Eigen::Index coordinate, double from_px,
        double to_px)
      : logarithmic_(axis.scale == Scale::kLogarithmic), from_px_(from_px), to_px_(to_px) {
    low_ = std::numeric_limits<double>::max();
    high_ = std::numeric_limits<double>::lowest();
    for (const auto& line : plot.lines) {
      for (const auto& point : line.points) {
        if (!shows(point[coordinate])) continue;
        low_ = std::min(low_, place(point[coordinate]));
        high_ = std::max(high_, place(point[coordinate]));
      }
    }
    if (!(low_ < high_)) throw std::runtime_error("nothing to plot: " + plot.title);
    const double margin = 0.04 * (high_ - low_);
    low_ -= margin;
    high_ += margin;
  }

  bool shows(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0.0); }

  double pixel(double value) const {
    return from_px_ + (place(value) - low_) / (high_ - low_) * (to_px_ - from_px_);
  }

  std::vector<double> ticks() const { return logarithmic_ ? logarithmic_ticks() : linear_ticks(); }

 private:
  double place(double value) const { return logarithmic_ ? std::log10(value) : value; }

  std::vector<double> logarithmic_ticks() const {
    const bool wide = high_ - low_ > 3.0;
    std::vector<double> ticks;
    for (double decade = std::floor(low_); decade <= high_; ++decade) {
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double tick = factor * std::pow(10.0, decade);
        if (wide && factor > 1.0) continue;
        if (place(tick) >= low_ && place(tick) <= high_) ticks.push_back(tick);
      }
    }
    return ticks;
  }

  std::vector<double> linear_ticks() const {
    const double rough = (high_ - low_) / 6.0;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = decade * (rough > 5 * decade ? 10 : rough > 2 * decade ? 5 : 2);
    std::vector<double> ticks;
    for (auto i = static_cast<int>(std::ceil(low_ / step)); i * step <= high_; ++i) {
      ticks.push_back(i * step);
    }
    return ticks;
  }

  bool logarithmic_;
  double from_px_;
  double to_px_;
  double low_ = 0.0;
  double high_ = 0.0;
};

std::string tick_text(double value) {
  if (value >= 1e6) return fmt::format("{:g} M", value / 1e6);
  if (value >= 1e4) return fmt::format("{:g} k", value / 1e3);
  return fmt::format("{:g}", value);
}

std::string grid(const LinePlot& plot, const Ruler& x, const Ruler& y) {
  const double right = kWidthPx - kRightPx;
  const double bottom = kHeightPx - kBottomPx;
  std::string text;
  for (const double tick : x.ticks()) {
    text += svg::line({x.pixel(tick), kTopPx}, {x.pixel(tick), bottom}, "grid");
    text += svg::label({x.pixel(tick), bottom + 18.0}, "middle", tick_text(tick));
  }
  for (const double tick : y.ticks()) {
    text += svg::line({kLeftPx, y.pixel(tick)}, {right, y.pixel(tick)}, "grid");
    text += svg::label({kLeftPx - 8.0, y.pixel(tick) + 4.5}, "end", tick_text(tick));
  }
  text += svg::line({kLeftPx, bottom}, {right, bottom}, "frame");
  text += svg::line({kLeftPx, kTopPx}, {kLeftPx, bottom}, "frame");
  text += svg::label({0.5 * (kLeftPx + right), bottom + 42.0}, "middle", plot.x.label);
  text += fmt::format("<g transform=\"translate(20 {:.1f}) rotate(-90)\">{}</g>\n",
                      0.5 * (kTopPx + bottom), svg::label({0.0, 0.0}, "middle", plot.y.label));
  return text;
}

std::string stroke(const std::vector<Vector2d>& pixels, std::size_t colour, bool dashed) {
  if (pixels.size() < 2) return {};
  return fmt::format("<polyline class=\"line c{}{}\" points=\"{}\"/>\n", colour,
                     dashed ? " dashed" : "", svg::point_list(pixels));
}

/// The pieces of a line between its interruptions, and its dots.
std::string drawn(const PlotLine& line, std::size_t colour, const Ruler& x, const Ruler& y) {
  std::string text;
  std::vector<Vector2d> piece, all;
  for (const auto& point : line.points) {
    if (x.shows(point.x()) && y.shows(point.y())) {
      piece.emplace_back(x.pixel(point.x()), y.pixel(point.y()));
      all.push_back(piece.back());
    } else {
      text += stroke(piece, colour, line.dashed);
      piece.clear();
    }
  }
  text += stroke(piece, colour, line.dashed);
  return text + svg::dots(all, line.dashed ? 2.0 : 3.4, fmt::format("dots c{}", colour));
}

/// Names at the height of their lines' ends, moved apart where they would touch.
std::string names(const LinePlot& plot, const Ruler& x, const Ruler& y) {
  struct Name {
    std::size_t line;
    double height;
  };
  std::vector<Name> places;
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    double height = kTopPx;
    for (const auto& point : plot.lines[i].points) {
      if (x.shows(point.x()) && y.shows(point.y())) height = y.pixel(point.y());
    }
    places.push_back({i, height});
  }
  std::sort(places.begin(), places.end(),
            [](const Name& a, const Name& b) { return a.height < b.height; });
  for (std::size_t i = 1; i < places.size(); ++i) {
    places[i].height = std::max(places[i].height, places[i - 1].height + kNameHeightPx);
  }
  const double over = places.back().height - (kHeightPx - kBottomPx);
  for (auto& name : places) name.height -= std::max(0.0, over);
  std::string text;
  for (const auto& name : places) {
    text += svg::label({kWidthPx - kRightPx + 10.0, name.height + 4.5},
                       fmt::format("n{}", name.line), plot.lines[name.line].name);
  }
  return text;
}

}  // namespace

std::string svg_of(const LinePlot& plot) {
  const Ruler x(plot, plot.x, 0, kLeftPx, kWidthPx - kRightPx);
  const Ruler y(plot, plot.y, 1, kHeightPx - kBottomPx, kTopPx);
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\">\n",
      kWidthPx, kHeightPx);
  text += kStyle;
  text += svg::label({kLeftPx, 26.0}, "title", plot.title);
  text += svg::label({kLeftPx, 48.0}, "note", plot.note);
  text += grid(plot, x, y);
  // The first line lies on top.
  for (std::size_t i = plot.lines.size(); i-- > 0;) text += drawn(plot.lines[i], i, x, y);
  text += names(plot, x, y);
  return text + "</svg>\n";
}

void write_svg(const LinePlot& plot, const std::filesystem::path& file) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file);
  out << svg_of(plot);
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace instep::bench
