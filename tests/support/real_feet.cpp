#include "tests/support/real_feet.h"

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/places.h"
#include "tests/support/shape_files.h"

namespace instep::test {

void RealFeet::SetUp() {
  if (!std::filesystem::exists(trial_data() / "feet")) GTEST_SKIP() << "no trial data";
}

PointCloud RealFeet::cloud(const char* name, double unit_mm) {
  return read_shape(trial_data() / "feet" / name, unit_mm).cloud;
}

MeasuredFoot measured(const PointCloud& cloud) {
  auto foot = align_foot(cloud).and_then(find_landmarks);
  if (!foot) throw std::runtime_error(foot.error().line());
  auto set = measure_foot(*foot);
  if (!set) throw std::runtime_error(set.error().line());
  return {*std::move(foot), *std::move(set)};
}

PointCloud noisy(PointCloud cloud, double sigma_mm, std::uint64_t seed) {
  cloud.normals.clear();
  return with_isotropic_noise(std::move(cloud), sigma_mm, seed);
}

PointCloud without(const PointCloud& cloud,
                   const std::function<bool(const Eigen::Vector3d&)>& is_in) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!is_in(cloud.positions[i])) kept.push_back(i);
  }
  return cloud.subset(kept);
}

}  // namespace instep::test
