// Time and memory of a girth over the number of points of a foot, one thread, reading apart.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "daemon/cloud_files/cloud_file.h"
#include "daemon/cloud_files/cloud_ply_writer.h"
#include "drivers/files/file_bytes.h"
#include "tests/bench/scaling/timed_girth.h"
#include "tests/bench/shared/girth_methods.h"
#include "tests/bench/shared/line_plot.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/cases/simulated_feet.h"
#include "tests/support/temporary_folder.h"

namespace instep::bench {
namespace {

constexpr double kNoiseMm = 0.3;

struct Contender {
  std::string name;
  GirthMethod girth;
  double noise_mm = 0.0;
};

std::vector<Contender> contenders() {
  std::vector<Contender> all;
  for (auto& method : girth_methods()) all.push_back({method.name, std::move(method.girth)});
  all.insert(all.begin() + 1, {"rbf, noise", all.front().girth, kNoiseMm});
  return all;
}

/// A simulated foot, its points evenly at random; a plane over it at a part of its length.
struct Subject {
  test::CaseBody body = test::simulated_feet(1).front();
  PointCloud points;
  PointCloud noisy;

  explicit Subject(std::size_t most) {
    points = body.crowd(most, 1);
    body.settle(points);
    noisy = test::with_noise(points, kNoiseMm, 2);
    points.normals.clear();
    noisy.normals.clear();
  }

  PointCloud first(std::size_t count, double noise_mm) const {
    const auto& all = noise_mm > 0.0 ? noisy.positions : points.positions;
    PointCloud cloud;
    cloud.positions.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
    return cloud;
  }
};

TapePlane plane_over(const Subject& subject, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  TapePlane plane = subject.body.plane(random);
  while (!subject.body.lengths(plane)) plane = subject.body.plane(random);
  return plane;
}

double reading_milliseconds(const PointCloud& cloud) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "foot.ply";
  if (!write_file_bytes(file, *cloud_to_ply(cloud))) return std::nan("");
  return median_milliseconds([&] { (void)read_cloud_file(file, LengthUnit::kMillimetre); });
}

/// By the contender's name.
using Timings = std::map<std::string, std::vector<TimedGirth>>;

void print_header(const std::vector<Contender>& all) {
  fmt::print("CPU time of a girth, ms, on one thread\n{:>9}{:>9}{:>9}", "points", "reading",
             "band");
  for (const auto& contender : all) fmt::print("{:>12}", contender.name);
  fmt::print("{:>12}{:>12}{:>12}\n", "paper / rbf", "peak memory", "error, mm");
}

void print_row(const std::vector<Contender>& all, const Timings& timings, std::size_t count,
               double reading, double truth) {
  const auto at = [&](const std::string& name) -> const TimedGirth* {
    const auto known = timings.find(name);
    if (known == timings.end() || known->second.back().points != count) return nullptr;
    return &known->second.back();
  };
  const TimedGirth* rbf = at("rbf");
  const TimedGirth* paper = at("rbf-paper");
  fmt::print("{:>9}{:>9.1f}{:>9}", count, reading, rbf ? rbf->band_points : 0);
  for (const auto& contender : all) {
    const TimedGirth* girth = at(contender.name);
    fmt::print("{:>12}", girth ? fmt::format("{:.1f}{}", girth->milliseconds,
                                             girth->stretched_mm ? "" : " ref")
                               : "-");
  }
  fmt::print("{:>12}{:>12}{:>12}\n",
             rbf && paper ? fmt::format("{:.1f}", paper->milliseconds / rbf->milliseconds) : "-",
             rbf ? fmt::format("{:.2f} x", rbf->peak_clouds) : "-",
             rbf && rbf->stretched_mm ? fmt::format("{:+.5f}", *rbf->stretched_mm - truth) : "-");
  std::fflush(stdout);
}

Timings table(const Subject& subject, const TapePlane& plane,
              const std::vector<std::size_t>& counts, double patience_s) {
  const auto all = contenders();
  const double truth = subject.body.lengths(plane)->stretched_mm;
  print_header(all);
  Timings timings;
  for (const std::size_t count : counts) {
    for (const auto& contender : all) {
      auto& known = timings[contender.name];
      if (!known.empty() && known.back().milliseconds > 1e3 * patience_s) continue;
      known.push_back(timed(contender.girth, subject.first(count, contender.noise_mm), plane));
    }
    print_row(all, timings, count, reading_milliseconds(subject.first(count, 0.0)), truth);
  }
  fmt::print("{:>27}", "growth, time ~ points^");
  for (const auto& contender : all) {
    const auto& known = timings.at(contender.name);
    fmt::print("{:>12}", known.size() > 1 ? fmt::format("{:.2f}", growth_exponent(known)) : "-");
  }
  fmt::print("\npeak memory: the cloud's and all that rbf takes, in units of the cloud's\n");
  return timings;
}

void print_bar(const std::string& name, double value, double bar, const char* unit) {
  fmt::print("{:<62}{:>9.2f}{}  bar {}{}  {}\n", name, value, unit, bar, unit,
             value <= bar ? "pass" : "MISS");
}

void bars(const Timings& timings) {
  const auto& rbf = timings.at("rbf");
  for (const auto& girth : rbf) {
    if (girth.points != 200000) continue;
    print_bar(fmt::format("a girth of a cloud of 200,000 points (its band: {})", girth.band_points),
              girth.milliseconds, 5.0, " ms");
  }
  print_bar(fmt::format("peak memory at {} points, in clouds", rbf.back().points),
            rbf.back().peak_clouds, 3.0, "");
}

/// As when a foot is measured: one cloud, several tapes.
void six_girths(const Subject& subject, std::size_t count) {
  const PointCloud cloud = subject.first(count, kNoiseMm);
  std::vector<TapePlane> planes;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) planes.push_back(plane_over(subject, seed));
  const double all = median_milliseconds([&] {
    for (const auto& plane : planes) (void)girth_by_rbf(cloud, plane);
  });
  fmt::print("six girths of one cloud of {} noisy points, one after the other: {:.1f} ms\n", count,
             all);
}

void plot(const Timings& timings, const std::filesystem::path& folder) {
  LinePlot plot = {.title = "The time of a girth",
                   .note = "simulated foot, one thread; rbf, noise: with 0.3 mm of it",
                   .x = {"points on the foot"},
                   .y = {"processor time, ms"},
                   .lines = {}};
  for (const auto& contender : contenders()) {
    PlotLine line = {.name = contender.name, .points = {}, .dashed = false};
    for (const auto& girth : timings.at(contender.name)) {
      line.points.emplace_back(static_cast<double>(girth.points), girth.milliseconds);
    }
    plot.lines.push_back(std::move(line));
  }
  // Its colour is that of rbf, whose it is.
  std::rotate(plot.lines.begin() + 1, plot.lines.begin() + 2, plot.lines.end());
  plot.lines.back().dashed = true;
  write_svg(plot, folder / "time_over_points.svg");
}

}  // namespace
}  // namespace instep::bench

int main(int count, char** words) {
  using namespace instep::bench;
  CLI::App app("Time and memory of a girth over the number of points");
  std::size_t most = 5000000;
  double patience_s = 5.0;
  app.add_option("--most", most, "Points of the largest cloud")
      ->check(CLI::Range(10000, 20000000))
      ->capture_default_str();
  app.add_option("--patience", patience_s, "A method that took longer, s, gets no larger cloud")
      ->capture_default_str();
  std::string plots;
  app.add_option("--plots", plots, "Also draw the times, as an SVG file in this folder");
  CLI11_PARSE(app, count, words);
  std::vector<std::size_t> counts;
  for (const std::size_t step : {10000U, 20000U, 50000U, 100000U, 200000U, 500000U, 1000000U,
                                 2000000U, 5000000U, 10000000U, 20000000U}) {
    if (step <= most) counts.push_back(step);
  }
  const Subject subject(counts.back());
  const auto timings = table(subject, plane_over(subject, 1), counts, patience_s);
  bars(timings);
  if (!plots.empty()) plot(timings, plots);
  six_girths(subject, std::min<std::size_t>(200000, counts.back()));
  return 0;
}
