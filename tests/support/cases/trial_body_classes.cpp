#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "tests/support/cases/case_classes.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/places.h"
#include "tests/support/shape_files.h"

namespace instep::test {
namespace {

using Cases = std::vector<GirthCase>;

enum class Noise { kNone, kAlongNormals, kAllRound };

struct Wanted {
  std::size_t count;
  double sigma_mm = 0.0;
  Noise noise = Noise::kNone;
  bool normals_told = false;
  std::uint64_t draws;
};

PointCloud made(PointCloud cloud, const Wanted& wanted, std::uint64_t seed) {
  if (wanted.noise == Noise::kAlongNormals) {
    cloud = with_noise(std::move(cloud), wanted.sigma_mm, seed);
  } else if (wanted.noise == Noise::kAllRound) {
    cloud = with_isotropic_noise(std::move(cloud), wanted.sigma_mm, seed);
  }
  if (!wanted.normals_told) cloud.normals.clear();
  return cloud;
}

GirthCase case_of(const KnownSection& section, const std::string& body, std::uint64_t seed,
                  const PointCloud& cloud, const char* sampling, const Wanted& wanted) {
  return {.name = fmt::format("{} {} {}", section.file, section.name, seed),
          .making = {.body = body,
                     .sampling = sampling,
                     .sigma_mm = wanted.sigma_mm,
                     .normals_told = wanted.normals_told},
          .cloud = cloud,
          .plane = section.plane,
          .stretched_mm = section.stretched_mm,
          .contact_mm = section.contact_mm,
          .floor_mm = {}};
}

std::set<std::string> files_of(const std::vector<KnownSection>& sections) {
  std::set<std::string> files;
  for (const auto& section : sections) files.insert(section.file);
  return files;
}

/// Some of a last's own vertices.
Cases last_cases(const Wanted& wanted, Pattern pattern) {
  Cases cases;
  const auto sections = known_sections("lasts");
  for (const auto& file : files_of(sections)) {
    const auto vertices = read_shape(trial_data() / "lasts" / file).cloud;
    const bool all_alike = wanted.count >= vertices.size() && wanted.noise == Noise::kNone;
    for (std::uint64_t seed = 1; seed <= (all_alike ? 1 : wanted.draws); ++seed) {
      // An even choice takes one point after the other: all but one in a random order.
      const auto crowd = pattern == Pattern::kEven
                             ? chosen(vertices, vertices.size() - 1, Pattern::kRandom, seed)
                             : vertices;
      const auto cloud = made(chosen(crowd, wanted.count, pattern, seed), wanted, seed + 1000);
      for (const auto& section : sections) {
        if (section.file != file) continue;
        const char* sampling = all_alike ? "as given" : name_of(pattern);
        cases.push_back(case_of(section, "last", seed, cloud, sampling, wanted));
      }
    }
  }
  return cases;
}

/// Blue noise on a foot's triangles.
Cases foot_cases(const Wanted& wanted, Pattern pattern) {
  constexpr std::size_t kCrowd = 10;
  Cases cases;
  const auto sections = known_sections("feet");
  for (const auto& file : files_of(sections)) {
    if (!file.ends_with(".stl")) continue;
    const auto mesh = read_shape(trial_data() / "feet" / file, 1000.0).mesh;
    for (std::uint64_t seed = 1; seed <= wanted.draws; ++seed) {
      const std::size_t crowd = wanted.count * (pattern == Pattern::kRandom ? 1 : kCrowd);
      const auto cloud =
          made(chosen(oriented_points_on(mesh, crowd, 0.0, seed), wanted.count, pattern, seed),
               wanted, seed + 1000);
      for (const auto& section : sections) {
        if (section.file != file) continue;
        cases.push_back(case_of(section, "foot", seed, cloud, name_of(pattern), wanted));
      }
    }
  }
  return cases;
}

CaseClass last_class(const std::string& name, const Bar& bar, const Wanted& wanted,
                     Pattern pattern = Pattern::kRandom) {
  return {"lasts", fmt::format("lasts{}", name), bar, [=] { return last_cases(wanted, pattern); }};
}

CaseClass foot_class(const std::string& name, const Bar& bar, const Wanted& wanted,
                     Pattern pattern = Pattern::kEven) {
  return {"feet", fmt::format("feet{}", name), bar, [=] { return foot_cases(wanted, pattern); }};
}

}  // namespace

std::vector<CaseClass> last_classes(std::uint64_t draws) {
  std::vector<CaseClass> classes;
  if (!std::filesystem::exists(trial_data())) return classes;
  const auto bar = [](double mean, std::optional<double> worst = {}) {
    return Bar{.mean_mm = mean, .worst_mm = worst, .bias_mm = {}};
  };
  const std::vector<std::pair<std::size_t, Bar>> exact = {
      {14240, bar(0.2, 0.6)}, {3560, bar(0.3, 1.0)}, {902, bar(0.6, 2.0)}};
  for (const bool told : {true, false}) {
    const char* normals = told ? "" : ", bare";
    for (const auto& [count, limit] : exact) {
      classes.push_back(last_class(fmt::format(", {} points{}", count, normals), limit,
                                   {.count = count, .normals_told = told, .draws = draws}));
    }
    for (const auto& [count, limit] : {exact[1], exact[2]}) {
      classes.push_back(last_class(fmt::format(", {} even points{}", count, normals), limit,
                                   {.count = count, .normals_told = told, .draws = draws},
                                   Pattern::kEven));
    }
    for (const auto& [count, limit] :
         {std::pair{14240U, bar(0.35)}, {3560U, Bar{}}, {902U, Bar{}}}) {
      classes.push_back(last_class(fmt::format(", {} points, 0.5 mm{}", count, normals), limit,
                                   {.count = count,
                                    .sigma_mm = 0.5,
                                    .noise = Noise::kAlongNormals,
                                    .normals_told = told,
                                    .draws = draws}));
    }
  }
  return classes;
}

std::vector<CaseClass> foot_classes(std::uint64_t draws) {
  std::vector<CaseClass> classes;
  if (!std::filesystem::exists(trial_data())) return classes;
  const auto bar = [](double mean) { return Bar{.mean_mm = mean, .worst_mm = {}, .bias_mm = {}}; };
  for (const auto& [count, mean] : {std::pair{17040U, 0.2}, {4260U, 0.2}, {1080U, 0.3}}) {
    classes.push_back(
        foot_class(fmt::format(", {} points", count), bar(mean), {.count = count, .draws = draws}));
  }
  for (const auto& [count, mean] : {std::pair{17040U, 0.25}, {4260U, 0.45}, {1080U, 0.65}}) {
    classes.push_back(foot_class(
        fmt::format(", {} points, 0.5 mm", count), bar(mean),
        {.count = count, .sigma_mm = 0.5, .noise = Noise::kAlongNormals, .draws = draws}));
  }
  for (const std::size_t count : {17040U, 4260U, 1080U}) {
    classes.push_back(
        foot_class(fmt::format(", {} points, 0.5 mm all round", count), Bar{},
                   {.count = count, .sigma_mm = 0.5, .noise = Noise::kAllRound, .draws = draws}));
  }
  for (const double sigma : {0.0, 0.1, 0.3}) {
    classes.push_back(
        foot_class(fmt::format(", 200000 random points, {:.1f} mm", sigma), Bar{},
                   {.count = 200000, .sigma_mm = sigma, .noise = Noise::kAlongNormals, .draws = 1},
                   Pattern::kRandom));
  }
  return classes;
}

}  // namespace instep::test
