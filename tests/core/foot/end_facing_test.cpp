#include "core/foot/end_facing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "core/foot/shoe_sizes.h"
#include "tests/support/cases/drawn_feet.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// A toe along x: a shaft of that radius with a half ball on its end, at x = `radius`.
std::vector<Vector3d> toe(double radius, double noise_mm) {
  test::RandomNumbers random(3);
  std::vector<Vector3d> points;
  for (int i = 0; i < 3000; ++i) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double along = random.uniform(-30.0, radius);  // even on both, by Archimedes
    const double across = along < 0.0 ? radius : std::sqrt(radius * radius - along * along);
    points.emplace_back(along, across * std::cos(angle), across * std::sin(angle));
    points.back() += noise_mm * Vector3d(random.normal(), random.normal(), random.normal());
  }
  return points;
}

TEST(EndFacing, IsNearOneWhereAToeClosesAndNearNoneWhereItIsCutOff) {
  for (const double radius : {7.0, 12.0, 25.0}) {
    for (const double noise_mm : {0.0, 0.4}) {
      SCOPED_TRACE(testing::Message() << radius << " " << noise_mm);
      auto points = toe(radius, noise_mm);
      EXPECT_GT(*end_facing(points, {radius, 0, 0}, Vector3d::UnitX()), 0.8);
      std::erase_if(points, [](const Vector3d& point) { return point.x() > -5.0; });
      EXPECT_LT(*end_facing(points, {-5.0, radius, 0}, Vector3d::UnitX()), 0.25);
    }
  }
}

TEST(EndFacing, IsNotToldWithoutPoints) {
  EXPECT_FALSE(end_facing({}, {0, 0, 0}, Vector3d::UnitX()));
  EXPECT_FALSE(end_facing({{-100, 0, 0}}, {0, 0, 0}, Vector3d::UnitX()));
}

/// Of a crowd each point had all others for neighbours: 60,000 took over a minute.
TEST(EndFacing, IsToldOfACrowd) {
  auto points = toe(12.0, 0.0);
  test::RandomNumbers random(5);
  for (int i = 0; i < 300000; ++i) {
    points.emplace_back(12.0 + 0.1 * random.normal(), 0.1 * random.normal(), 0.1 * random.normal());
  }
  EXPECT_GT(*end_facing(points, {12.0, 0, 0}, Vector3d::UnitX()), 0.8);
}

/// Without what lies before `least` or after `most` of its length, in its own frame.
FootScan cut_foot(const FootScan& foot, double least, double most) {
  FootScan cut = foot;
  std::erase_if(cut.cloud.positions,
                [&](const Vector3d& point) { return point.x() < least || point.x() > most; });
  const auto again = align_foot(cut.cloud).and_then(find_landmarks);
  if (!again) throw std::runtime_error(again.error().line());
  return *again;
}

/// The length, and what is said of it.
Measure length_of(const FootScan& foot) {
  const auto set = measure_foot(foot);
  if (!set || set->find("foot_length") == nullptr) throw std::runtime_error("no length");
  return *set->find("foot_length");
}

bool warns_of(const Measure& measure, const char* part) {
  return std::any_of(
      measure.warnings.begin(), measure.warnings.end(),
      [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
}

/// A foot that reached out of view was told as a shorter one, to half a millimetre.
TEST(FootLength, OfAFootWithoutItsEndsSaysThatItMayBeMore) {
  for (const std::uint64_t seed : {2U, 5U, 7U}) {
    SCOPED_TRACE(seed);
    const auto foot = align_foot(test::draw_scanned_foot_without_truth(seed).cloud);
    ASSERT_TRUE(foot) << foot.error().line();
    const double length = foot->landmarks.at("acropodion").position_mm.x();
    const Measure whole = length_of(cut_foot(*foot, -1e3, 1e3));
    EXPECT_TRUE(whole.warnings.empty());
    EXPECT_LT(*whole.u95_mm, 3.0);
    const Measure toeless = length_of(cut_foot(*foot, -1e3, length - 15.0));
    EXPECT_TRUE(warns_of(toeless, "the foremost part of the toes was not seen"));
    EXPECT_FALSE(warns_of(toeless, "heel"));
    EXPECT_GE(*toeless.u95_mm, 10.0);
    EXPECT_FALSE(sized_foot({.measures = {toeless}, .withheld = {}}).length_mm) << "no size";
    EXPECT_TRUE(sized_foot({.measures = {whole}, .withheld = {}}).length_mm);
    const Measure heelless = length_of(cut_foot(*foot, 25.0, 1e3));
    EXPECT_TRUE(warns_of(heelless, "the rearmost part of the heel was not seen"));
    EXPECT_FALSE(warns_of(heelless, "toes"));
  }
}

}  // namespace
}  // namespace instep
