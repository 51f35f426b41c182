#include "tests/support/cases/point_patterns.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "tests/support/random_numbers.h"

namespace instep::test {
namespace {

using Eigen::Vector3d;
using Indices = std::vector<std::size_t>;

/// The `count` points with the smallest keys.
Indices smallest(const std::vector<double>& keys, std::size_t count) {
  Indices order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  order.resize(std::min(count, order.size()));
  return order;
}

Vector3d random_direction(RandomNumbers& random) {
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

Indices at_random(const PointCloud& crowd, std::size_t count, RandomNumbers& random) {
  std::vector<double> keys(crowd.size());
  for (auto& key : keys) key = random.uniform();
  return smallest(keys, count);
}

/// Distance between `count` points if those of the crowd are spread evenly at random.
double mean_spacing(const PointCloud& crowd, const PointIndex& index, std::size_t count) {
  constexpr double kNearestAmongRandom = 0.47;  // median distance times the root of the density
  return median_nearest_distance(index) / kNearestAmongRandom *
         std::sqrt(static_cast<double>(crowd.size()) / static_cast<double>(count));
}

/// One after the other, unless it lies too near an earlier one. The distance is found by halving.
Indices evenly(const PointCloud& crowd, std::size_t count) {
  const PointIndex index(crowd.positions);
  const double spacing = mean_spacing(crowd, index, count);
  double near = 0.1 * spacing;
  double far = 1.1 * spacing;
  Indices kept;
  for (int round = 0; round < 9; ++round) {
    const double distance = 0.5 * (near + far);
    std::vector<bool> gone(crowd.size(), false);
    Indices found;
    for (std::size_t i = 0; i < crowd.size() && found.size() <= count; ++i) {
      if (gone[i]) continue;
      found.push_back(i);
      for (const auto& other : index.within(crowd.positions[i], distance)) gone[other.index] = true;
    }
    (found.size() > count ? near : far) = distance;
    if (found.size() <= count) kept = std::move(found);
  }
  return kept;
}

/// Draws without putting back, by weights that fall along a direction (Efraimidis and Spirakis).
Indices graded(const PointCloud& crowd, std::size_t count, RandomNumbers& random) {
  constexpr double kContrast = 6.0;
  const Vector3d direction = random_direction(random);
  std::vector<double> along;
  for (const auto& position : crowd.positions) along.push_back(direction.dot(position));
  const auto [low, high] = std::minmax_element(along.begin(), along.end());
  std::vector<double> keys;
  for (const double place : along) {
    const double weight = std::pow(kContrast, -(place - *low) / (*high - *low));
    keys.push_back(-std::log(1.0 - random.uniform()) / weight);
  }
  return smallest(keys, count);
}

Indices in_lines(const PointCloud& crowd, std::size_t count, RandomNumbers& random) {
  constexpr double kLineToPoint = 3.0;
  const PointIndex index(crowd.positions);
  const double pitch = std::sqrt(kLineToPoint) * mean_spacing(crowd, index, count);
  const Vector3d across = random_direction(random) / pitch;
  const double shift = random.uniform();
  std::vector<double> keys;
  for (const auto& position : crowd.positions) {
    const double line = across.dot(position) + shift;
    keys.push_back(std::abs(line - std::round(line)));
  }
  return smallest(keys, count);
}

}  // namespace

const char* name_of(Pattern pattern) {
  switch (pattern) {
    case Pattern::kRandom:
      return "random";
    case Pattern::kEven:
      return "even";
    case Pattern::kGraded:
      return "graded";
    case Pattern::kLines:
      return "lines";
  }
  return "";
}

PointCloud chosen(const PointCloud& crowd, std::size_t count, Pattern pattern, std::uint64_t seed) {
  if (count >= crowd.size()) return crowd;
  RandomNumbers random(seed);
  switch (pattern) {
    case Pattern::kEven:
      return crowd.subset(evenly(crowd, count));
    case Pattern::kGraded:
      return crowd.subset(graded(crowd, count, random));
    case Pattern::kLines:
      return crowd.subset(in_lines(crowd, count, random));
    case Pattern::kRandom:
      break;
  }
  return crowd.subset(at_random(crowd, count, random));
}

PointCloud with_hole(const PointCloud& cloud, const TapePlane& plane, double diameter_mm,
                     std::uint64_t seed) {
  std::vector<double> heights;
  for (const auto& position : cloud.positions)
    heights.push_back(std::abs(plane.distance(position)));
  const Indices near_plane = smallest(heights, 20);
  const Vector3d middle = cloud.positions[near_plane[RandomNumbers(seed).below(near_plane.size())]];
  Indices kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if ((cloud.positions[i] - middle).norm() > 0.5 * diameter_mm) kept.push_back(i);
  }
  return cloud.subset(kept);
}

PointCloud with_noise(PointCloud cloud, double sigma_mm, std::uint64_t seed) {
  RandomNumbers random(seed);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.positions[i] += sigma_mm * random.normal() * cloud.normals[i];
  }
  return cloud;
}

PointCloud with_isotropic_noise(PointCloud cloud, double sigma_mm, std::uint64_t seed) {
  RandomNumbers random(seed);
  for (auto& position : cloud.positions) {
    position += sigma_mm * Vector3d(random.normal(), random.normal(), random.normal());
  }
  return cloud;
}

}  // namespace instep::test
