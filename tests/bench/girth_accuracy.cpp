// Errors of the girth methods over shapes with known sections, densities and noise, and the
// processor time a girth takes.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/places.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shape_files.h"

namespace instep {
namespace {

/// The errors of one class of cases.
struct Tally {
  std::vector<double> errors;
  std::vector<double> milliseconds;
  int refused = 0;
  int with_interval = 0;
  int held = 0;
};

bool g_verbose = false;

void measure(Tally& tally, const PointCloud& cloud, const test::KnownSection& section,
             const std::string& label) {
  const std::clock_t begin = std::clock();
  const auto girth = girth_by_rbf(cloud, section.plane);
  const std::clock_t end = std::clock();
  const double ms = 1e3 * static_cast<double>(end - begin) / CLOCKS_PER_SEC;
  tally.milliseconds.push_back(ms);
  if (!girth) {
    ++tally.refused;
    if (g_verbose) fmt::print("    {} refused: {}\n", label, girth.error().line());
    return;
  }
  const double error = girth->stretched_mm - section.stretched_mm;
  tally.errors.push_back(error);
  if (girth->stretched_u95_mm) {
    ++tally.with_interval;
    if (std::abs(error) <= *girth->stretched_u95_mm) ++tally.held;
  }
  if (g_verbose) {
    fmt::print(
        "    {:<44} stretched {:+8.4f} contact {:+8.4f} u95 {:.4f} sigma {:.4f} gap {:.1f} "
        "band {} {:.1f} ms\n",
        label, error, girth->contact_mm - section.contact_mm,
        girth->stretched_u95_mm.value_or(-1.0), girth->sigma_mm, girth->largest_gap_mm,
        girth->band_points, ms);
  }
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(1, values.size()));
}

void print(const std::string& name, Tally tally) {
  std::vector<double> sizes;
  for (const double error : tally.errors) sizes.push_back(std::abs(error));
  std::sort(sizes.begin(), sizes.end());
  std::sort(tally.milliseconds.begin(), tally.milliseconds.end());
  if (sizes.empty()) sizes.push_back(std::nan(""));
  fmt::print(
      "{:<26} n {:3} refused {:2}  mean {:8.4f} worst {:8.4f} bias {:+8.4f}  held {}/{}  "
      "{:.1f} ms\n",
      name, tally.errors.size(), tally.refused, mean(sizes), sizes.back(), mean(tally.errors),
      tally.held, tally.with_interval, tally.milliseconds[tally.milliseconds.size() / 2]);
}

/// Every k-th of a shuffled cloud, with noise along the normals where there are some.
PointCloud sample(const PointCloud& cloud, std::size_t count, double sigma, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (count < cloud.size()) {
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[random.below(i + 1)]);
    order.resize(count);
  }
  PointCloud part = cloud.subset(order);
  for (std::size_t i = 0; i < part.size() && part.has_normals(); ++i) {
    part.positions[i] += sigma * random.normal() * part.normals[i];
  }
  return part;
}

/// Points of a mesh that keep about the same distance from each other: random ones, from which each
/// that lies too near an earlier one is left out. The distance is found by halving.
/// The noise goes in all directions alike, not along the normal alone.
PointCloud even_points_on(const TriangleMesh& mesh, std::size_t count, double sigma,
                          std::uint64_t seed) {
  const PointCloud crowd = test::points_on(mesh, 12 * count, 0.0, seed);
  const PointIndex index(crowd.positions);
  std::vector<std::size_t> kept;
  double near = 0.0;
  double far = 20.0;
  for (int round = 0; round < 12; ++round) {
    const double distance = 0.5 * (near + far);
    std::vector<bool> gone(crowd.size(), false);
    kept.clear();
    for (std::size_t i = 0; i < crowd.size(); ++i) {
      if (gone[i]) continue;
      kept.push_back(i);
      if (kept.size() > count) break;
      for (const auto& neighbour : index.within(crowd.positions[i], distance)) {
        gone[neighbour.index] = true;
      }
    }
    (kept.size() > count ? near : far) = distance;
  }
  PointCloud even = crowd.subset(kept);
  test::RandomNumbers random(seed + 1000);
  for (auto& position : even.positions) {
    position += sigma * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
  return even;
}

void shapes() {
  std::map<std::string, Tally> tallies;
  for (const auto& section : test::known_sections("shapes")) {
    const auto shape = test::read_shape(test::trial_data() / "shapes" / section.file);
    const std::string size = section.file.find("hole") != std::string::npos
                                 ? "hole"
                                 : fmt::format("{} sigma {}", shape.cloud.size(), section.sigma_mm);
    measure(tallies["shapes " + size], shape.cloud, section, section.file);
  }
  for (const auto& [name, tally] : tallies) print(name, tally);
}

void lasts() {
  for (const bool normals : {true, false}) {
    for (const double sigma : {0.0, 0.5}) {
      for (const std::size_t count : {14240U, 3560U, 902U}) {
        Tally tally;
        for (const auto& section : test::known_sections("lasts")) {
          const auto shape = test::read_shape(test::trial_data() / "lasts" / section.file);
          for (const std::uint64_t seed : {1U, 2U, 3U}) {
            if (count == 14240 && sigma == 0.0 && seed > 1) continue;
            PointCloud cloud = sample(shape.cloud, count, sigma, seed);
            if (!normals) cloud.normals.clear();
            measure(tally, cloud, section, section.file + " " + section.name);
          }
        }
        print(fmt::format("lasts {} s {} {}", count, sigma, normals ? "normals" : "bare"), tally);
      }
    }
  }
}

void feet() {
  for (const double sigma : {0.0, 0.5}) {
    for (const std::size_t count : {17000U, 4260U, 1080U}) {
      Tally tally;
      for (const auto& section : test::known_sections("feet")) {
        if (!section.file.ends_with(".stl")) continue;
        const auto shape = test::read_shape(test::trial_data() / "feet" / section.file, 1000.0);
        for (const std::uint64_t seed : {1U, 2U}) {
          auto cloud = even_points_on(shape.mesh, count, sigma, seed);
          measure(tally, cloud, section, section.file + " " + section.name);
        }
      }
      print(fmt::format("feet {} s {}", count, sigma), tally);
    }
  }
}

void analytic() {
  const std::vector<std::string> names = {"circle",    "ellipse",      "cone",
                                          "ellipsoid", "superellipse", "bent tube"};
  const std::vector<test::AnalyticShape> bodies = {
      test::elliptic_cylinder(40, 40), test::elliptic_cylinder(48, 28), test::cone(38, 0.25),
      test::ellipsoid(50, 35, 70),     test::superellipse(42, 38, 3.0), test::bent_tube(90, 35)};
  const auto plane = TapePlane::through({0, 0, 1}, {10, 0, 3}, {0, 10, 0}).value();
  for (const double sigma : {0.0, 0.1, 0.3, 0.5, 1.0}) {
    for (const std::size_t count : {450U, 1200U, 8000U}) {
      Tally tally;
      for (const auto& body : bodies) {
        const double truth = test::true_girth(body, plane);
        for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
          const auto cloud = test::random_points(body, count, -30, 30, sigma, seed);
          measure(tally, cloud, {"", "", plane, sigma, truth, truth},
                  names[static_cast<std::size_t>(&body - bodies.data())]);
        }
      }
      print(fmt::format("analytic {} s {}", count, sigma), tally);
    }
  }
}

void dense_foot() {
  for (const double sigma : {0.0, 0.3}) {
    Tally tally;
    for (const auto& section : test::known_sections("feet")) {
      if (!section.file.ends_with(".stl")) continue;
      const auto shape = test::read_shape(test::trial_data() / "feet" / section.file, 1000.0);
      measure(tally, test::points_on(shape.mesh, 200000, sigma, 1), section,
              section.file + " " + section.name);
    }
    print(fmt::format("feet 200000 s {}", sigma), tally);
  }
}

}  // namespace
}  // namespace instep

int main(int count, char** words) {
  std::vector<std::string> wanted(words + 1, words + count);
  instep::g_verbose = std::erase(wanted, "-v") > 0;
  const std::vector<std::pair<std::string, std::function<void()>>> parts = {
      {"shapes", instep::shapes},
      {"lasts", instep::lasts},
      {"feet", instep::feet},
      {"analytic", instep::analytic},
      {"dense", instep::dense_foot}};
  if (!std::filesystem::exists(instep::test::trial_data())) {
    fmt::print("no trial data here\n");
    return 0;
  }
  for (const auto& [name, run] : parts) {
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end()) run();
  }
  return 0;
}
