#include <fmt/core.h>

#include <utility>

#include "tests/support/cases/case_classes.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/cases/simulated_feet.h"

namespace instep::test {
namespace {

constexpr std::size_t kFeet = 5;
constexpr std::uint64_t kPlanesOfFoot = 4;
constexpr std::size_t kCrowd = 10;

/// A foot's cloud, and planes over it as they are drawn.
std::vector<GirthCase> cases_of(const CaseBody& foot, std::size_t points, double sigma_mm,
                                std::uint64_t seed) {
  PointCloud cloud = chosen(foot.crowd(kCrowd * points, seed), points, Pattern::kEven, seed);
  foot.settle(cloud);
  if (sigma_mm > 0.0) cloud = with_noise(std::move(cloud), sigma_mm, seed);
  cloud.normals.clear();
  CaseMaking making;
  making.body = foot.name;
  making.sampling = name_of(Pattern::kEven);
  making.sigma_mm = sigma_mm;
  RandomNumbers random(seed);
  std::vector<GirthCase> cases;
  while (cases.size() < kPlanesOfFoot) {
    const TapePlane plane = foot.plane(random);
    const auto lengths = foot.lengths(plane);
    if (!lengths) continue;
    cases.push_back({.name = fmt::format("simulated foot {}, plane {}", seed, cases.size() + 1),
                     .making = making,
                     .cloud = cloud,
                     .plane = plane,
                     .stretched_mm = lengths->stretched_mm,
                     .contact_mm = lengths->contact_mm,
                     .floor_mm = {}});
  }
  return cases;
}

std::vector<GirthCase> foot_cases(std::size_t points, double sigma_mm) {
  std::vector<GirthCase> cases;
  std::uint64_t seed = 0;
  for (const auto& foot : simulated_feet(kFeet)) {
    for (auto& one : cases_of(foot, points, sigma_mm, ++seed)) cases.push_back(std::move(one));
  }
  return cases;
}

}  // namespace

std::vector<CaseClass> simulated_foot_classes() {
  std::vector<CaseClass> classes;
  for (const double sigma : {0.0, 0.5}) {
    for (const std::size_t points : {17040U, 4260U, 1080U}) {
      const std::string noise = sigma > 0.0 ? fmt::format(", {:.1f} mm", sigma) : "";
      classes.push_back({"simulated", fmt::format("simulated feet, {} points{}", points, noise),
                         Bar{}, [=] { return foot_cases(points, sigma); }});
    }
  }
  return classes;
}

}  // namespace instep::test
