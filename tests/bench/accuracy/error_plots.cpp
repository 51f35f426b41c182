#include "tests/bench/accuracy/error_plots.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <vector>

#include "tests/bench/shared/girth_methods.h"
#include "tests/bench/shared/line_plot.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/cases/simulated_feet.h"
#include "tests/support/places.h"

namespace instep::bench {
namespace {

constexpr std::size_t kFeet = 8;
constexpr std::uint64_t kPlanesOfFoot = 3;

struct Subject {
  PointCloud cloud;
  TapePlane plane;
  double stretched_mm;
};

/// The cases that a plot shows at one place of its x axis.
using Subjects = std::function<std::vector<Subject>(double at)>;

PointCloud noisy_bare(PointCloud cloud, double sigma_mm, std::uint64_t seed) {
  if (sigma_mm > 0.0) cloud = test::with_noise(std::move(cloud), sigma_mm, seed);
  cloud.normals.clear();
  return cloud;
}

std::vector<Subject> on_feet(const std::vector<test::CaseBody>& feet, double points,
                             double sigma_mm) {
  std::vector<Subject> subjects;
  for (std::uint64_t number = 0; number < feet.size(); ++number) {
    const auto& foot = feet[number];
    PointCloud cloud = foot.crowd(static_cast<std::size_t>(points), number + 1);
    foot.settle(cloud);
    cloud = noisy_bare(std::move(cloud), sigma_mm, number + 100);
    test::RandomNumbers random(number + 1);
    for (std::uint64_t drawn = 0; drawn < kPlanesOfFoot;) {
      const TapePlane plane = foot.plane(random);
      const auto lengths = foot.lengths(plane);
      if (!lengths) continue;
      ++drawn;
      subjects.push_back({cloud, plane, lengths->stretched_mm});
    }
  }
  return subjects;
}

std::vector<Subject> on_lasts(double points, bool normals_told) {
  std::vector<Subject> subjects;
  std::map<std::string, PointCloud> clouds;
  for (const auto& section : test::known_sections("lasts")) {
    auto& cloud = clouds[section.file];
    if (cloud.empty()) {
      cloud = test::chosen(test::read_shape(test::trial_data() / "lasts" / section.file).cloud,
                           static_cast<std::size_t>(points), test::Pattern::kRandom, 1);
      if (!normals_told) cloud.normals.clear();
    }
    subjects.push_back({cloud, section.plane, section.stretched_mm});
  }
  return subjects;
}

/// Sizes of a method's errors; one that refuses is as wrong as can be.
std::vector<double> error_sizes(const GirthMethod& method, const std::vector<Subject>& subjects) {
  std::vector<double> sizes;
  for (const auto& subject : subjects) {
    const auto girth = method(subject.cloud, subject.plane);
    sizes.push_back(girth ? std::abs(girth->stretched_mm - subject.stretched_mm)
                          : std::numeric_limits<double>::infinity());
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

std::vector<PlotLine> error_lines(const std::vector<double>& places, const Subjects& subjects) {
  std::vector<PlotLine> lines;
  for (const auto& method : girth_methods()) {
    lines.push_back({.name = method.name, .points = {}, .dashed = false});
  }
  lines.push_back({.name = "rbf, worst", .points = {}, .dashed = true});
  for (const double place : places) {
    const auto here = subjects(place);
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      const auto sizes = error_sizes(girth_methods()[i].girth, here);
      lines[i].points.emplace_back(place, sizes[sizes.size() / 2]);
      if (i == 0) lines.back().points.emplace_back(place, sizes.back());
    }
    fmt::print(stderr, "plotted at {}\n", place);
  }
  return lines;
}

PlotLine with_told_normals(const std::vector<double>& places) {
  PlotLine line{.name = "rbf, with normals", .points = {}, .dashed = false};
  for (const double place : places) {
    const auto sizes = error_sizes(girth_methods().front().girth, on_lasts(place, true));
    line.points.emplace_back(place, sizes[sizes.size() / 2]);
  }
  return line;
}

LinePlot error_plot(const std::string& title, const std::string& note, const PlotAxis& x,
                    const std::vector<double>& places, const Subjects& subjects) {
  LinePlot plot;
  plot.title = title;
  plot.note = note;
  plot.x = x;
  plot.y.label = "error of the girth, mm";
  plot.lines = error_lines(places, subjects);
  return plot;
}

}  // namespace

void write_error_plots(const std::filesystem::path& folder) {
  const PlotAxis points = {"points on the body", Scale::kLogarithmic};
  const PlotAxis noise = {"noise of a point, mm", Scale::kLinear};
  const auto feet = test::simulated_feet(kFeet);
  const std::size_t girths = kFeet * kPlanesOfFoot;
  write_svg(error_plot("Few points or many",
                       fmt::format("median of {} girths of simulated feet, exact points", girths),
                       points, {500, 1000, 2000, 4000, 8000, 16000, 32000},
                       [&](double at) { return on_feet(feet, at, 0.0); }),
            folder / "error_over_density.svg");
  write_svg(error_plot("Clean points or noisy",
                       fmt::format("median of {} girths of simulated feet, 16000 points", girths),
                       noise, {0.0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0},
                       [&](double at) { return on_feet(feet, 16000, at); }),
            folder / "error_over_noise.svg");
  if (!std::filesystem::exists(test::trial_data())) return;
  const std::vector<double> densities = {500, 1000, 2000, 4000, 8000, 14240};
  auto lasts = error_plot("Creased and uneven: shoe lasts",
                          "median of 9 girths of production lasts, exact points without normals",
                          points, densities, [](double at) { return on_lasts(at, false); });
  lasts.lines.push_back(with_told_normals(densities));
  write_svg(lasts, folder / "error_over_density_on_lasts.svg");
}

}  // namespace instep::bench
