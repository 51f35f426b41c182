#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "tests/support/analytic_shapes.h"
#include "tests/support/cases/case_bodies.h"
#include "tests/support/cases/case_classes.h"
#include "tests/support/cases/noise_floor.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/places.h"
#include "tests/support/shape_files.h"

namespace instep::test {
namespace {

using Cases = std::vector<GirthCase>;

constexpr double kMostTiltDegrees = 15.0;

/// The paper's models, of several distances of the rings and heights of the plane: it tells none.
Cases ring_cases(int per_ring, int rings) {
  constexpr double kGirth = 80.0 * std::numbers::pi;
  Cases cases;
  for (const double twist : {0.0, 0.5}) {
    for (const double pitch : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0}) {
      for (const double part : {0.0, 0.25, 0.5}) {
        const double z = part * pitch;
        cases.push_back({.name = fmt::format("rings {} mm apart, twist {}, z {}", pitch, twist, z),
                         .making = {.body = "cylinder", .sampling = "rings"},
                         .cloud = cylinder_rings(per_ring, rings, pitch, twist),
                         .plane = TapePlane::through({0, 0, z}, {1, 0, z}, {0, 1, z}).value(),
                         .stretched_mm = kGirth,
                         .contact_mm = kGirth,
                         .floor_mm = {}});
      }
    }
  }
  return cases;
}

/// The files of the trial data whose names hold a word.
Cases trial_shapes(const std::string& word) {
  Cases cases;
  if (!std::filesystem::exists(trial_data())) return cases;
  for (const auto& section : known_sections("shapes")) {
    if (section.file.find(word) == std::string::npos) continue;
    if (section.file.find("grid") != std::string::npos) continue;
    cases.push_back(
        {.name = section.file,
         .making = {.body = "trial shape", .sampling = "as given", .sigma_mm = section.sigma_mm},
         .cloud = read_shape(trial_data() / "shapes" / section.file).cloud,
         .plane = section.plane,
         .stretched_mm = section.stretched_mm,
         .contact_mm = section.contact_mm,
         .floor_mm = {}});
  }
  return cases;
}

/// Every smooth body with `seeds` clouds and planes of its own, and the trial shapes of that name.
Cases shape_cases(std::size_t count, double sigma_mm, double hole_mm, std::uint64_t seeds,
                  const std::string& trial_word) {
  Cases cases = trial_shapes(trial_word);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    // Of the body, so that planes are the same without the trial data.
    std::uint64_t number = 0;
    for (const auto& body : smooth_bodies(seed)) {
      RandomNumbers random(100 * seed + number++);
      const TapePlane plane = tilted_plane(kMostTiltDegrees, random);
      const auto lengths = body.lengths(plane).value();
      PointCloud cloud = body.crowd(count, seed + 1);
      if (hole_mm > 0.0) cloud = with_hole(cloud, plane, hole_mm, seed + 2);
      if (sigma_mm > 0.0) cloud = with_noise(std::move(cloud), sigma_mm, seed + 3);
      cloud.normals.clear();
      cases.push_back({.name = fmt::format("{} {}", body.name, seed),
                       .making = {.body = body.name,
                                  .sampling = "random",
                                  .sigma_mm = sigma_mm,
                                  .hole_mm = hole_mm},
                       .cloud = std::move(cloud),
                       .plane = plane,
                       .stretched_mm = lengths.stretched_mm,
                       .contact_mm = lengths.contact_mm,
                       .floor_mm = noise_floor(lengths, count, sigma_mm)});
    }
  }
  return cases;
}

}  // namespace

std::vector<CaseClass> smooth_classes() {
  std::vector<CaseClass> classes;
  for (const auto& [per_ring, rings] : {std::pair{120, 10}, {60, 15}, {30, 15}}) {
    classes.push_back(
        {"rings",
         fmt::format("cylinder of {} rings of {}", rings, per_ring),
         {.mean_mm = {}, .worst_mm = 0.001, .bias_mm = {}},
         [per_ring = per_ring, rings = rings] { return ring_cases(per_ring, rings); }});
  }
  for (const auto& [count, worst] : {std::pair{6000U, 0.002}, {1500U, 0.005}, {450U, 0.06}}) {
    classes.push_back(
        {"shapes",
         fmt::format("exact shapes, {} points", count),
         {.mean_mm = {}, .worst_mm = worst, .bias_mm = {}},
         [count = count] { return shape_cases(count, 0.0, 0.0, 4, fmt::format("_{}.", count)); }});
  }
  for (const double sigma : {0.2, 0.5, 1.0}) {
    classes.push_back(
        {"noise",
         fmt::format("noise of {:.1f} mm, 8000 points", sigma),
         {.mean_mm = {}, .worst_mm = 0.4 * sigma, .bias_mm = 0.05 * sigma},
         [=] { return shape_cases(8000, sigma, 0.0, 5, fmt::format("noise_{:.1f}", sigma)); }});
  }
  for (const auto& [hole, worst] : {std::pair{10, 0.02}, {20, 0.1}}) {
    classes.push_back(
        {"holes",
         fmt::format("hole of {} mm, 4000 points", hole),
         {.mean_mm = {}, .worst_mm = worst, .bias_mm = {}},
         [hole = hole] { return shape_cases(4000, 0.0, hole, 4, fmt::format("hole_{}", hole)); }});
  }
  return classes;
}

}  // namespace instep::test
