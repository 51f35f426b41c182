#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "core/girth/girth.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/places.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shape_files.h"

namespace instep {
namespace {

using Eigen::Vector3d;

class ToldNormalsOfTrialData : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(test::trial_data())) GTEST_SKIP() << "no trial data here";
  }
};

constexpr std::size_t kPoints = 2000;
constexpr std::uint64_t kSeeds = 3;
constexpr std::uint64_t kNoisySeeds = 24;

/// Errors of the girths of the lasts, from few points of each.
struct Errors {
  int girths = 0;
  int held = 0;  ///< by their intervals
  double worst_mm = 0.0;
};

template <class Change>
Errors errors_with(const Change& change) {
  std::map<std::string, PointCloud> lasts;
  Errors errors;
  for (const auto& section : test::known_sections("lasts")) {
    if (!lasts.contains(section.file)) {
      lasts[section.file] = test::read_shape(test::trial_data() / "lasts" / section.file).cloud;
    }
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      auto cloud = test::chosen(lasts[section.file], kPoints, test::Pattern::kRandom, seed);
      test::RandomNumbers random(seed);
      change(cloud, random);
      const auto girth = girth_by_rbf(cloud, section.plane);
      EXPECT_TRUE(girth) << girth.error().line();
      if (!girth) continue;
      const double off = std::abs(girth->stretched_mm - section.stretched_mm);
      ++errors.girths;
      if (off <= girth->stretched_u95_mm.value()) ++errors.held;
      errors.worst_mm = std::max(errors.worst_mm, off);
    }
  }
  return errors;
}

/// As of a scanner that takes some from the wrong side of an edge.
void turn_one_in_twenty(PointCloud& cloud, test::RandomNumbers& random) {
  for (auto& normal : cloud.normals) {
    if (random.uniform() > 0.05) continue;
    const Vector3d aside(random.normal(), random.normal(), random.normal());
    normal = (normal + 0.5 * aside).normalized();
  }
}

// Measured: at most 1.56 mm off, 25 of 27 intervals hold (with 32 draws each 272 of 288); taken as
// slopes, 8.95 mm and 21.
TEST_F(ToldNormalsOfTrialData, OfWhichAFewAreFarOffSpoilNoLast) {
  const auto errors = errors_with(turn_one_in_twenty);
  EXPECT_GT(errors.girths, 0);
  EXPECT_GE(errors.held, errors.girths - 3);
  EXPECT_LT(errors.worst_mm, 2.0);
}

double mean_error(const PointCloud& last, const test::KnownSection& section, double noise_mm,
                  bool told) {
  double sum_mm = 0.0;
  for (std::uint64_t seed = 1; seed <= kNoisySeeds; ++seed) {
    auto cloud = test::with_noise(last, noise_mm, seed);
    if (!told) cloud.normals.clear();
    const auto girth = girth_by_rbf(cloud, section.plane);
    EXPECT_TRUE(girth) << girth.error().line();
    if (girth) sum_mm += std::abs(girth->stretched_mm - section.stretched_mm);
  }
  return sum_mm / static_cast<double>(kNoisySeeds);
}

// The tape crosses an edge, which noise hides. Measured: 2 % further off than bare; 11 % where
// patches end at that edge by what was told.
TEST_F(ToldNormalsOfTrialData, OfNoisyPointsDoNoHarm) {
  double told_mm = 0.0;
  double bare_mm = 0.0;
  for (const auto& section : test::known_sections("lasts")) {
    if (section.name.find("instep") == std::string::npos) continue;
    const auto last = test::read_shape(test::trial_data() / "lasts" / section.file).cloud;
    told_mm += mean_error(last, section, 0.5, true);
    bare_mm += mean_error(last, section, 0.5, false);
  }
  EXPECT_GT(bare_mm, 0.0);
  EXPECT_LT(told_mm, 1.06 * bare_mm) << bare_mm;
}

}  // namespace
}  // namespace instep
