#include "core/foot/measures/unseen_ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/foot/align_feet.h"
#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "core/foot/shoe_sizes.h"
#include "tests/support/cases/drawn_feet.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Without what lies before `least` or after `most` of its length, in its own frame.
FootScan cut_foot(const FootScan& foot, double least, double most) {
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < foot.cloud.size(); ++i) {
    const double along = foot.cloud.positions[i].x();
    if (along >= least && along <= most) left.push_back(i);
  }
  const auto again = align_foot(foot.cloud.subset(left)).and_then(find_landmarks);
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
TEST(UnseenEnds, MakeTheLengthAGuessAndSaySo) {
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

/// What is placed by a length that is not all of it was told to a millimetre: the long heel girth,
/// by the instep point, 7 mm off.
TEST(UnseenEnds, AreInTheIntervalsOfAllThatIsPlacedByTheLength) {
  for (const std::uint64_t seed : {5U, 7U}) {
    const auto foot = align_foot(test::draw_scanned_foot_without_truth(seed).cloud);
    ASSERT_TRUE(foot) << foot.error().line();
    const double length = foot->landmarks.at("acropodion").position_mm.x();
    const auto whole = measure_foot(cut_foot(*foot, -1e3, 1e3));
    const auto toeless = measure_foot(cut_foot(*foot, -1e3, length - 8.0));
    ASSERT_TRUE(whole && toeless);
    ASSERT_FALSE(toeless->find("foot_length")->warnings.empty());
    for (const char* id : {"long_heel_girth", "instep_girth", "instep_height", "ankle_girth",
                           "ball_length", "ball_girth", "waist_girth"}) {
      SCOPED_TRACE(std::to_string(seed) + " " + id);
      const Measure* here = toeless->find(id);
      const Measure* there = whole->find(id);
      ASSERT_TRUE(here && there);
      EXPECT_NEAR(here->value_mm, there->value_mm, std::hypot(*here->u95_mm, *there->u95_mm));
    }
  }
}

/// The rearmost place of what was left of a heel was a corner of it: the axis turned by 5 to 9
/// degrees, and breadths were up to 9 mm off, by intervals of some 2.5.
TEST(UnseenEnds, OfAHeelDoNotTurnTheFoot) {
  int asked = 0;
  int missed = 0;
  for (const std::uint64_t seed : {3U, 7U}) {
    const auto foot = align_foot(test::draw_scanned_foot_without_truth(seed).cloud);
    ASSERT_TRUE(foot) << foot.error().line();
    const auto whole = measure_foot(cut_foot(*foot, -1e3, 1e3));
    for (const double cut_mm : {8.0, 14.0}) {
      const FootScan heelless = cut_foot(*foot, cut_mm, 1e3);
      const Vector3d axis = heelless.foot_from_input.linear() * Vector3d::UnitX();
      EXPECT_LT(std::abs(std::atan2(axis.y(), axis.x())), 0.01) << seed << " " << cut_mm;
      const auto set = measure_foot(heelless);
      ASSERT_TRUE(whole && set);
      for (const char* id : {"foot_length", "foot_breadth", "foot_breadth_horizontal", "ball_girth",
                             "ball_length", "toe1_angle", "instep_height", "waist_girth"}) {
        SCOPED_TRACE(std::to_string(seed) + " " + id);
        const Measure* here = set->find(id);
        const Measure* there = whole->find(id);
        ASSERT_TRUE(here && there);
        ++asked;
        const double moved = std::abs(here->value() - there->value());
        EXPECT_LT(moved, 2.0 * std::hypot(*here->u95(), *there->u95()));
        if (moved > std::hypot(*here->u95(), *there->u95())) ++missed;
      }
      EXPECT_NEAR(set->find("foot_breadth")->value_mm, whole->find("foot_breadth")->value_mm, 1.0);
    }
  }
  EXPECT_LE(20 * missed, asked) << "of 95 % intervals";
}

/// It was the points' fault, which "do not tell how sure its landmarks are". How much has to be cut
/// off for a junction that a longer foot would not show hangs on the foot, and on its noise.
TEST(UnseenEnds, AreTheReasonWhereALongerFootCouldNotBeMeasuredSo) {
  const auto is_the_reason = [](const WithheldMeasure& one) {
    return one.reason.find("an end of the foot was not seen") != std::string::npos;
  };
  int told = 0;
  for (const std::uint64_t seed : {13U, 24U}) {
    const auto foot = align_foot(test::draw_scanned_foot_without_truth(seed).cloud);
    ASSERT_TRUE(foot) << foot.error().line();
    const double length = foot->landmarks.at("acropodion").position_mm.x();
    for (const double cut_mm : {10.0, 25.0}) {
      const auto set = measure_foot(cut_foot(*foot, -1e3, length - cut_mm));
      ASSERT_TRUE(set) << set.error().line();
      told += std::any_of(set->withheld.begin(), set->withheld.end(), is_the_reason) ? 1 : 0;
    }
  }
  EXPECT_GT(told, 0);
}

TEST(UnseenEnds, AreNoneOfAWholeFoot) {
  const auto foot =
      align_foot(test::draw_scanned_foot_without_truth(2).cloud).and_then(find_landmarks);
  ASSERT_TRUE(foot) << foot.error().line();
  EXPECT_FALSE(unseen_ends(*foot));
}

/// Each landmark that stands at a part of the length moves by that part.
TEST(UnseenEnds, TellWhereLandmarksLieIfTheFootGoesOn) {
  const auto foot = align_foot(test::draw_scanned_foot_without_truth(2).cloud);
  ASSERT_TRUE(foot) << foot.error().line();
  const FootScan heelless = cut_foot(*foot, 25.0, 1e3);
  const auto ends = unseen_ends(heelless);
  ASSERT_TRUE(ends);
  ASSERT_EQ(ends->if_longer.size(), 2U) << "further back, and turned";
  const auto& longer = ends->if_longer.front();
  const auto place_of = [&](const char* name) -> Vector3d {
    return longer.foot_from_redrawn * longer.landmarks.at(name).position_mm;
  };
  const auto own = [&](const char* name) -> Vector3d {
    return heelless.landmarks.at(name).position_mm;
  };
  const double unseen = own("pternion").x() - place_of("pternion").x();
  EXPECT_GT(unseen, 15.0);
  EXPECT_LT(unseen, 26.0);
  EXPECT_NEAR(place_of("acropodion").x(), own("acropodion").x(), 1e-9);
  EXPECT_NEAR(place_of("instep_point").x(), own("instep_point").x() - 0.5 * unseen, 2.0);
}

}  // namespace
}  // namespace instep
