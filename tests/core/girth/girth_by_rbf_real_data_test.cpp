#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "core/girth/girth.h"
#include "tests/support/places.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shape_files.h"

namespace instep {
namespace {

class GirthByRbfOfTrialData : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(test::trial_data())) GTEST_SKIP() << "no trial data here";
  }
};

double error_of(const PointCloud& cloud, const test::KnownSection& section) {
  const auto girth = girth_by_rbf(cloud, section.plane);
  EXPECT_TRUE(girth) << girth.error().line();
  return girth ? girth->stretched_mm - section.stretched_mm : 1e9;
}

/// What a shape of the trial data has to meet, by its noise and its number of points.
double tolerance_mm(const test::KnownSection& section, std::size_t points) {
  if (section.sigma_mm > 0.0) return 0.4 * section.sigma_mm;
  if (section.file.starts_with("cylinder")) return 0.001;
  return points < 1000 ? 0.03 : 0.002;
}

TEST_F(GirthByRbfOfTrialData, MeetsAnalyticShapes) {
  for (const auto& section : test::known_sections("shapes")) {
    const auto shape = test::read_shape(test::trial_data() / "shapes" / section.file);
    EXPECT_NEAR(error_of(shape.cloud, section), 0.0, tolerance_mm(section, shape.cloud.size()))
        << section.file;
  }
}

/// Of which no camera saw the sole: the truth is the hull of what was seen.
TEST_F(GirthByRbfOfTrialData, LaysTheTapeOverTheOpenSoleOfAScannedFoot) {
  const std::string file = "lab_left.ply";
  const auto foot = test::read_shape(test::trial_data() / "feet" / file);
  int sections = 0;
  for (const auto& section : test::known_sections("feet")) {
    if (section.file != file) continue;
    EXPECT_NEAR(error_of(foot.cloud, section), 0.0, 1.0) << section.name;
    ++sections;
  }
  EXPECT_EQ(sections, 3);
}

/// Mean error over the sections of the lasts, each from `count` points drawn at random.
double mean_error_on_lasts(std::size_t count, std::uint64_t seed) {
  double sum = 0.0;
  int sections = 0;
  for (const auto& section : test::known_sections("lasts")) {
    const auto shape = test::read_shape(test::trial_data() / "lasts" / section.file);
    std::vector<std::size_t> order(shape.cloud.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    test::RandomNumbers random(seed);
    for (std::size_t i = order.size() - 1; i > 0; --i) {
      std::swap(order[i], order[random.below(i + 1)]);
    }
    order.resize(std::min(count, order.size()));
    sum += std::abs(error_of(shape.cloud.subset(order), section));
    ++sections;
  }
  return sum / sections;
}

TEST_F(GirthByRbfOfTrialData, MeetsLastsFromDenseAndSparsePoints) {
  EXPECT_LT(mean_error_on_lasts(14240, 1), 0.5);
  EXPECT_LT(mean_error_on_lasts(3560, 1), 0.5);
  EXPECT_LT(mean_error_on_lasts(902, 1), 1.6);
}

TEST_F(GirthByRbfOfTrialData, MeetsFeetFromTheCornersOfTheirMeshes) {
  for (const auto& section : test::known_sections("feet")) {
    if (!section.file.ends_with(".stl")) continue;
    const auto shape = test::read_shape(test::trial_data() / "feet" / section.file, 1000.0);
    EXPECT_NEAR(error_of(shape.cloud, section), 0.0, 0.8) << section.file << section.name;
  }
}

struct Outcomes {
  int count = 0;
  int held = 0;
  double errors = 0.0;  ///< their sum

  double mean_error() const { return errors / count; }

  void add(const Outcomes& other) {
    count += other.count;
    held += other.held;
    errors += other.errors;
  }
};

/// Girths of scanned feet from points anywhere on their faces, so far off along the normals.
Outcomes on_faces_of_feet(std::size_t points, double sigma_mm = 0.0) {
  Outcomes outcomes;
  for (const auto& section : test::known_sections("feet")) {
    if (!section.file.ends_with(".stl")) continue;
    const auto mesh = test::read_shape(test::trial_data() / "feet" / section.file, 1000.0).mesh;
    auto cloud = test::oriented_points_on(mesh, points, sigma_mm, 1);
    cloud.normals.clear();
    const auto girth = girth_by_rbf(cloud, section.plane);
    EXPECT_TRUE(girth) << girth.error().line();
    if (!girth) continue;
    const double error = std::abs(girth->stretched_mm - section.stretched_mm);
    outcomes.held += error <= girth->stretched_u95_mm.value_or(0.0);
    outcomes.errors += error;
    ++outcomes.count;
  }
  return outcomes;
}

// Measured: 0.10 and 0.07 mm, five of six within their intervals. Where facets passed for noise and
// crowds were averaged, 0.16 and 0.11 mm, and one.
TEST_F(GirthByRbfOfTrialData, KeepsTheCornersOfScannedFeet) {
  EXPECT_LT(on_faces_of_feet(17040).mean_error(), 0.14);
  const auto crowded = on_faces_of_feet(200000);
  EXPECT_LT(crowded.mean_error(), 0.09);
  EXPECT_GE(crowded.held, 4) << "of " << crowded.count;
}

// Measured: 0.10 mm, 34 of 36 within their intervals. Where no more waves were expected than
// neighbours tell of, 0.17 mm, and 18.
TEST_F(GirthByRbfOfTrialData, ExpectsWhatNoiseHidesOfScannedFeet) {
  Outcomes all;
  for (const double sigma_mm : {0.02, 0.1, 0.3}) {
    for (const std::size_t points : {60000U, 200000U}) all.add(on_faces_of_feet(points, sigma_mm));
  }
  EXPECT_LT(all.mean_error(), 0.13);
  EXPECT_GE(all.held, 31) << "of " << all.count;
}

TEST_F(GirthByRbfOfTrialData, RefusesOrBridgesTheUnseenSole) {
  for (const auto& section : test::known_sections("feet")) {
    if (section.file != "lab_left.ply") continue;
    const auto shape = test::read_shape(test::trial_data() / "feet" / section.file);
    const auto girth = girth_by_rbf(shape.cloud, section.plane);
    if (!girth) continue;
    EXPECT_GT(girth->largest_gap_mm, 20.0);
    EXPECT_FALSE(girth->warnings.empty());
  }
}

}  // namespace
}  // namespace instep
