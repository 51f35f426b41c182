#include "core/foot/landmarks/other_side.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "tests/support/cases/drawn_feet.h"

namespace instep {
namespace {

FootScan marked(const Result<FootScan>& aligned) {
  const auto foot =
      aligned.and_then([](FootScan known) { return find_landmarks(std::move(known)); });
  if (!foot) throw std::runtime_error(foot.error().line());
  return *foot;
}

/// As a foot of that side, whether it is or not.
Result<FootScan> as(Side side, const PointCloud& cloud) {
  AlignmentOptions options;
  options.side = side;
  return align_foot(cloud, options);
}

/// As one whose shape hardly told the side.
FootScan marked_by_guess(Side side, const PointCloud& cloud) {
  auto foot = as(side, cloud);
  if (foot) foot->side_confidence = 0.6;
  return marked(foot);
}

MeasureSet measured(const FootScan& foot) {
  const auto set = measure_foot(foot);
  if (!set) throw std::runtime_error(set.error().line());
  return *set;
}

/// Why a measure was withheld.
std::string reason_of(const std::string& id, const MeasureSet& set) {
  for (const auto& one : set.withheld) {
    if (one.id == id) return one.reason;
  }
  return "";
}

class OtherSide : public testing::TestWithParam<std::uint64_t> {
 protected:
  const PointCloud cloud_ = test::draw_scanned_foot_without_truth(GetParam()).cloud;
};

TEST_P(OtherSide, IsNotAskedForWhereTheSideIsSure) {
  const FootScan foot = marked(align_foot(cloud_));
  EXPECT_GE(foot.side_confidence, 0.8);
  EXPECT_FALSE(landmarks_of_other_side(foot));
  EXPECT_FALSE(foot.redraws.of_other_side);
}

/// Taken for the wrong foot, it is measured as the right one too.
TEST_P(OtherSide, IsWithinAllIntervals) {
  const Side side = marked(align_foot(cloud_)).side;
  const FootScan guessed = marked_by_guess(other_side(side), cloud_);
  const FootScan known = marked(as(side, cloud_));
  const auto truth = measured(known);
  std::size_t compared = 0;
  double furthest_off = 0.0;
  for (const Measure& measure : measured(guessed).measures) {
    const Measure* true_one = truth.find(measure.id);
    if (true_one == nullptr || !measure.u95()) continue;
    EXPECT_NEAR(measure.value(), true_one->value(), *measure.u95()) << measure.id;
    if (!measure.value_deg) {
      furthest_off = std::max(furthest_off, std::abs(measure.value() - true_one->value()));
    }
    ++compared;
  }
  EXPECT_GE(compared, 6U);
  EXPECT_GT(furthest_off, 1.0) << "the side does not matter: nothing was tested";
  const RigidTransform guessed_from_known =
      guessed.foot_from_input * known.foot_from_input.inverse();
  for (const auto& [name, landmark] : guessed.landmarks) {
    const auto true_one = known.landmarks.find(name);
    if (true_one == known.landmarks.end() || !landmark.radius_mm) continue;
    EXPECT_LE((landmark.position_mm - guessed_from_known * true_one->second.position_mm).norm(),
              *landmark.radius_mm)
        << name;
  }
}

TEST_P(OtherSide, ThatDoesNotGiveAMeasureWithholdsIt) {
  FootScan foot = marked_by_guess(Side::kRight, cloud_);
  ASSERT_TRUE(foot.redraws.of_other_side);
  ASSERT_EQ(foot.redraws.of_other_side->landmarks.erase("acropodion"), 1U);
  const auto set = measured(foot);
  EXPECT_EQ(set.find("foot_length"), nullptr);
  const std::string why = reason_of("foot_length", set);
  EXPECT_NE(why.find("hardly tells left from right"), std::string::npos) << why;
}

/// More frames would not help.
TEST_P(OtherSide, ThatIsTooFarOffIsAskedFor) {
  FootScan foot = marked_by_guess(Side::kRight, cloud_);
  foot.redraws.of_other_side->landmarks.at("toe1_top").position_mm.z() += 30.0;
  const std::string why = reason_of("toe1_height", measured(foot));
  EXPECT_NE(why.find("say which foot it is"), std::string::npos) << why;
  foot.redraws.of_other_side.reset();
  foot.side_confidence = 1.0;
  EXPECT_EQ(reason_of("toe1_height", measured(foot)), "");
}

/// The interval of the other foot, if it is as wide, is in that of the one: a girth's surface too.
TEST_P(OtherSide, WidensTheWholeInterval) {
  const FootScan foot = marked_by_guess(Side::kRight, cloud_);
  FootScan sure = foot;
  sure.side_confidence = 1.0;
  sure.redraws.of_other_side.reset();
  FootScan apart = sure;
  apart.redraws.of_other_side = {foot.landmarks, RigidTransform::Identity()};
  apart.redraws.of_other_side->landmarks.at("instep_point").position_mm.x() += 4.0;
  const Measure narrow = *measured(sure).find("instep_girth");
  const Measure wide = *measured(apart).find("instep_girth");
  ASSERT_TRUE(narrow.parts && wide.parts);
  EXPECT_GT(narrow.parts->surface, 0.0);
  EXPECT_EQ(wide.parts->surface, narrow.parts->surface);
  EXPECT_NEAR(std::hypot(wide.parts->surface, wide.parts->landmarks), *wide.u95_mm, 1e-9);
  FootScan moved = sure;
  moved.landmarks = apart.redraws.of_other_side->landmarks;
  const double distance =
      std::abs(measured(moved).find("instep_girth")->value_mm - narrow.value_mm);
  EXPECT_GT(distance, 0.3);
  EXPECT_NEAR(*wide.u95_mm, *narrow.u95_mm + distance, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(OfDrawnFeet, OtherSide, testing::Values(2, 5, 7));

}  // namespace
}  // namespace instep
