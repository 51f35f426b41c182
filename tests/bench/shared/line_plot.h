#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace instep::bench {

enum class Scale { kLinear, kLogarithmic };

struct PlotAxis {
  std::string label;
  Scale scale = Scale::kLogarithmic;
};

/// A line through its points, from left to right. A point that is not finite, or not positive on a
/// logarithmic axis, interrupts it.
struct PlotLine {
  std::string name;
  std::vector<Eigen::Vector2d> points;
  bool dashed = false;
};

struct LinePlot {
  std::string title;
  std::string note;  ///< what the lines were measured on; below the title
  PlotAxis x;
  PlotAxis y;
  std::vector<PlotLine> lines;  ///< at most five, the one that matters first
};

/// The plot as an SVG page without a background, in colours that can be read on white and on black;
/// each line is named at its right end.
std::string svg_of(const LinePlot& plot);

/// Throws std::runtime_error if the file cannot be written.
void write_svg(const LinePlot& plot, const std::filesystem::path& file);

}  // namespace instep::bench
