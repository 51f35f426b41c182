#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "tests/support/cases/case_classes.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/cases/simulated_feet.h"

namespace instep::test {
namespace {

constexpr std::size_t kFeet = 5;
constexpr std::uint64_t kPlanesOfFoot = 4;
constexpr std::size_t kCrowd = 10;

/// So many points of the whole foot, each with this noise.
PointCloud seen_evenly(const CaseBody& foot, std::size_t points, double sigma_mm,
                       std::uint64_t seed) {
  PointCloud cloud = chosen(foot.crowd(kCrowd * points, seed), points, Pattern::kEven, seed);
  foot.settle(cloud);
  return with_noise(std::move(cloud), sigma_mm, seed);
}

/// As if one camera stood twice as far away as the other: those of its side are a quarter as many,
/// and scatter four times as much.
PointCloud seen_from_near_and_afar(const CaseBody& foot, std::size_t points, double sigma_mm,
                                   std::uint64_t seed) {
  constexpr double kTimes = 4.0;
  const PointCloud crowd = foot.crowd(kCrowd * points, seed);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& place : crowd.positions) middle += place;
  middle /= static_cast<double>(crowd.size());
  std::vector<std::size_t> near_side;
  std::vector<std::size_t> far_side;
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    (crowd.positions[i].y() > middle.y() ? near_side : far_side).push_back(i);
  }
  const auto side = [&](const std::vector<std::size_t>& members, double thinned, double sigma) {
    const double count = static_cast<double>(members.size()) / (kCrowd * thinned);
    PointCloud cloud = chosen(crowd.subset(members), static_cast<std::size_t>(std::lround(count)),
                              Pattern::kEven, seed);
    foot.settle(cloud);
    return with_noise(std::move(cloud), sigma, seed);
  };
  PointCloud cloud = side(near_side, 1.0, sigma_mm);
  const PointCloud afar = side(far_side, kTimes, kTimes * sigma_mm);
  cloud.positions.insert(cloud.positions.end(), afar.positions.begin(), afar.positions.end());
  cloud.normals.insert(cloud.normals.end(), afar.normals.begin(), afar.normals.end());
  return cloud;
}

using Seen = decltype(seen_evenly);

/// A foot's cloud, and planes over it as they are drawn.
std::vector<GirthCase> cases_of(const CaseBody& foot, Seen seen, std::size_t points,
                                double sigma_mm, std::uint64_t seed) {
  PointCloud cloud = seen(foot, points, sigma_mm, seed);
  cloud.normals.clear();
  CaseMaking making;
  making.body = foot.name;
  making.sampling = seen == seen_evenly ? name_of(Pattern::kEven) : "near and afar";
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

std::vector<GirthCase> foot_cases(Seen seen, std::size_t points, double sigma_mm) {
  std::vector<GirthCase> cases;
  std::uint64_t seed = 0;
  for (const auto& foot : simulated_feet(kFeet)) {
    for (auto& one : cases_of(foot, seen, points, sigma_mm, ++seed))
      cases.push_back(std::move(one));
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
                         Bar{}, [=] { return foot_cases(seen_evenly, points, sigma); }});
    }
  }
  for (const std::size_t points : {17040U, 4260U}) {
    for (const double sigma : {0.05, 0.2}) {
      classes.push_back({"simulated",
                         fmt::format("near and afar, {} points, {:.2f} mm", points, sigma), Bar{},
                         [=] { return foot_cases(seen_from_near_and_afar, points, sigma); }});
    }
  }
  return classes;
}

}  // namespace instep::test
