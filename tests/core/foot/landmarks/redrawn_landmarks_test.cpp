#include "core/foot/landmarks/redrawn_landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "tests/support/foot_body.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Values = std::vector<std::optional<double>>;

TEST(Redraws, GiveStudentsIntervalOfTheWhole) {
  // Four partings into halves of +1 and -1: a part has variance 2, the whole 1, with four degrees.
  const Values values{1.0, -1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0};
  EXPECT_NEAR(u95_of_redraws(values, {2, false}).value(), 2.776, 0.01);
}

TEST(Redraws, HoldTheMeanOfThePartsInNineteenOfTwentyCases) {
  test::RandomNumbers random(5);
  constexpr int kCases = 4000;
  int held = 0;
  for (int i = 0; i < kCases; ++i) {
    Values parts;
    double mean = 0.0;
    for (int k = 0; k < 8; ++k) {
      parts.emplace_back(random.normal());
      mean += *parts.back() / 8.0;
    }
    if (std::abs(mean) <= u95_of_redraws(parts, {8, false}).value()) ++held;
  }
  EXPECT_NEAR(static_cast<double>(held) / kCases, 0.95, 0.012);
}

TEST(Redraws, ThatLeaveOutPartsHoldTheMeanInNineteenOfTwentyCases) {
  test::RandomNumbers random(6);
  constexpr int kCases = 4000;
  int held = 0;
  for (int i = 0; i < kCases; ++i) {
    double sum = 0.0;
    std::vector<double> parts;
    for (int k = 0; k < 8; ++k) sum += parts.emplace_back(random.normal());
    Values without;
    for (const double part : parts) without.emplace_back((sum - part) / 7.0);
    if (std::abs(sum / 8.0) <= u95_of_redraws(without, {8, true}).value()) ++held;
  }
  EXPECT_NEAR(static_cast<double>(held) / kCases, 0.95, 0.012);
}

TEST(Redraws, SayNothingFromTooFew) {
  EXPECT_FALSE(u95_of_redraws({}, {2, false}));
  EXPECT_FALSE(u95_of_redraws(Values{1.0, 2.0}, {2, false}));
  EXPECT_FALSE(u95_of_redraws(Values{1.0, std::nullopt, 2.0, std::nullopt}, {4, true}));
}

TEST(Redraws, SayNothingWhereThereAreNone) {
  EXPECT_FALSE(u95_of_redraws({}, {}));
  EXPECT_FALSE(u95_by_redraws(1.0, {}, {}));
}

TEST(Redraws, ReachFromWhatWasToldToWhereTheyLie) {
  const Values values{1.0, -1.0, 1.0, -1.0, -1.0, std::nullopt, 1.0, -1.0};
  const double near = u95_by_redraws(0.0, values, {2, false}).value();
  EXPECT_GT(near, u95_of_redraws(values, {2, false}).value());
  EXPECT_NEAR(u95_by_redraws(7.0, values, {2, false}).value(), 7.0 + 1.0 / 7.0, 1e-9);
  EXPECT_NEAR(u95_by_redraws(-7.0, values, {2, false}).value(), 7.0 - 1.0 / 7.0, 1e-9);
}

/// An extreme of points falls short by as much as one over their number: the whole does by three
/// times what leaving out a fourth adds to that.
TEST(Redraws, ThatLeaveOutPartsReachToTheBiasOfTheWhole) {
  const Values short_ends{-1.1, -0.9, -1.0, -1.0, -1.0, -1.0, -0.9, -1.1};
  EXPECT_NEAR(u95_by_redraws(0.0, short_ends, {4, true}).value(), 3.0, 1e-9);
  EXPECT_NEAR(u95_by_redraws(0.0, short_ends, {4, true, true}).value(), 1.0, 1e-9);
  EXPECT_NEAR(u95_by_redraws(0.0, short_ends, {4, false}).value(), 1.0, 1e-9);
}

/// They were other draws wherever a processor rounds otherwise.
TEST(Redraws, AreTheSameWhateverTheLastBitsOfPlaces) {
  const PointCloud cloud = test::FootBody{}.points();
  PointCloud rounded = cloud;
  for (auto& position : rounded.positions) position *= 1.0 + 1e-14;
  const auto draws = align_foot(cloud).and_then(find_landmarks).value().redraws.landmarks;
  const auto others = align_foot(rounded).and_then(find_landmarks).value().redraws.landmarks;
  ASSERT_FALSE(draws.empty());
  ASSERT_EQ(others.size(), draws.size());
  for (std::size_t i = 0; i < draws.size(); ++i) {
    for (const auto& [name, landmark] : draws[i].landmarks) {
      const auto other = others[i].landmarks.find(name);
      ASSERT_NE(other, others[i].landmarks.end()) << name;
      EXPECT_NEAR((other->second.position_mm - landmark.position_mm).norm(), 0.0, 1e-4) << name;
    }
  }
}

TEST(Redraws, AreTheSameByWhateverWorkers) {
  const auto aligned = align_foot(test::FootBody{}.points()).value();
  const auto in_turn = find_landmarks(aligned).value();
  const Workers backwards = [](std::size_t count, const std::function<void(std::size_t)>& work) {
    while (count-- > 0) work(count);
  };
  const auto other = find_landmarks_by(backwards, aligned).value();
  ASSERT_FALSE(in_turn.landmarks.empty());
  ASSERT_EQ(other.redraws.landmarks.size(), in_turn.redraws.landmarks.size());
  for (const auto& [name, landmark] : in_turn.landmarks) {
    EXPECT_EQ(other.landmarks.at(name).position_mm, landmark.position_mm) << name;
    EXPECT_EQ(other.landmarks.at(name).radius_mm, landmark.radius_mm) << name;
  }
}

TEST(Redraws, TellByPairsWhatErringLeavesOpen) {
  const Values values{5.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
  const Values erring{7.0, 1.0, 2.0, 1.0, 6.0, 5.0, 6.0, 5.0};
  // A root mean square of 1.414, and 2.306 of it for eight degrees of freedom.
  EXPECT_NEAR(u95_of_erring(values, erring).value(), 2.306 * std::sqrt(2.0), 0.01);
}

/// What is off by as much in all pairs leaves as much open: it is no error of their mean.
TEST(Redraws, TakeWhatAllPairsAreOffForErring) {
  const Values values{1.0, 2.0, 3.0, 4.0};
  const Values erring{1.5, 2.5, 3.5, 4.5};
  EXPECT_NEAR(u95_of_erring(values, erring).value(), 2.776 * 0.5, 0.01);
}

TEST(Redraws, TellErringByPairsThatAreWhole) {
  const Values values{1.0, std::nullopt, 3.0, 4.0};
  const Values erring{2.0, 9.0, std::nullopt, 3.0};
  EXPECT_NEAR(u95_of_erring(values, erring).value(), 4.303, 0.01);
  EXPECT_FALSE(u95_of_erring(values, Values{2.0, 9.0, std::nullopt, std::nullopt}));
  EXPECT_EQ(u95_of_erring(values, {}), 0.0);
}

TEST(Redraws, HoldWhatErrsInNineteenOfTwentyCases) {
  test::RandomNumbers random(7);
  constexpr int kCases = 4000;
  int held = 0;
  for (int i = 0; i < kCases; ++i) {
    Values values;
    Values erring;
    for (int k = 0; k < 8; ++k) {
      values.emplace_back(random.normal());
      erring.emplace_back(*values.back() + 0.3 * random.normal());
    }
    if (std::abs(0.3 * random.normal()) <= u95_of_erring(values, erring).value()) ++held;
  }
  EXPECT_NEAR(static_cast<double>(held) / kCases, 0.95, 0.012);
}

/// With normals that are near enough: a foot is roundish across, and at its ends along, too.
PointCloud foot_with_normals() {
  const test::FootBody body{260.0, 3.0};
  PointCloud cloud = body.points();
  for (const auto& point : cloud.positions) {
    const double end = std::clamp(point.x(), 30.0, body.length_mm - 15.0);
    const Vector3d arm(point.x() - end, point.y(), point.z() - 12.0);
    cloud.normals.push_back(point.z() < 1.0 ? -Vector3d::UnitZ() : arm.normalized());
  }
  return cloud;
}

PointCloud erring(PointCloud cloud, double sigma_mm, double reach_mm) {
  cloud.local_errors = {std::vector<double>(cloud.size(), sigma_mm), reach_mm};
  return cloud;
}

FootScan marked(const PointCloud& cloud) {
  return align_foot(cloud).and_then(find_landmarks).value();
}

/// From the heel, where the frame of a foot begins.
double length_of(const RedrawnLandmarks& redrawn) {
  return redrawn.landmarks.at("acropodion").position_mm.x();
}

TEST(Redraws, DoNotErrWhereTheCloudKnowsOfNone) {
  const auto foot = marked(foot_with_normals());
  EXPECT_FALSE(foot.redraws.landmarks.empty());
  EXPECT_TRUE(foot.redraws.erring.empty());
}

/// Errors that reach further than a foot is long move all of its skin outwards alike: each of its
/// ends by as much, and nothing is averaged out.
TEST(Redraws, ErrByAsMuchAsTheSkin) {
  constexpr double kSigmaMm = 0.5;
  const auto exact = marked(foot_with_normals());
  const auto foot = marked(erring(foot_with_normals(), kSigmaMm, 1000.0));
  const auto& own = foot.redraws.landmarks;
  const auto& erring = foot.redraws.erring;
  ASSERT_EQ(erring.size(), own.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    squares += std::pow(length_of(erring[i]) - length_of(own[i]), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(own.size())), 2.0 * kSigmaMm, 0.4);
  for (const auto& [name, landmark] : foot.landmarks) {
    EXPECT_GT(landmark.radius_mm.value(), exact.landmarks.at(name).radius_mm.value()) << name;
  }
  for (const auto* name : {"acropodion", "toe1_tip"}) {
    const double wider = std::pow(*foot.landmarks.at(name).radius_mm, 2) -
                         std::pow(*exact.landmarks.at(name).radius_mm, 2);
    EXPECT_NEAR(std::sqrt(wider), 2.306 * kSigmaMm, 0.45) << name;
  }
}

/// How far each redraw's foot is longer for its errors.
std::vector<double> growths_of(const FootScan& foot) {
  std::vector<double> growths;
  for (std::size_t i = 0; i < foot.redraws.erring.size(); ++i) {
    growths.push_back(length_of(foot.redraws.erring[i]) - length_of(foot.redraws.landmarks[i]));
  }
  return growths;
}

/// Else the luck of some few draws would be that of all feet. The same foot draws the same.
TEST(Redraws, DrawOtherErrorsOfAnotherFoot) {
  const PointCloud cloud = erring(foot_with_normals(), 0.5, 1000.0);
  std::vector<std::size_t> but_one(cloud.size() - 1);
  std::iota(but_one.begin(), but_one.end(), std::size_t{0});
  const auto growths = growths_of(marked(cloud));
  EXPECT_EQ(growths_of(marked(cloud)), growths);
  const auto others = growths_of(marked(cloud.subset(but_one)));
  ASSERT_EQ(others.size(), growths.size());
  double apart = 0.0;
  for (std::size_t i = 0; i < growths.size(); ++i) apart += std::abs(others[i] - growths[i]);
  EXPECT_GT(apart / static_cast<double>(growths.size()), 0.3);
}

/// A foot of which a scanner left lines across it, the first of them `first_mm` before its heel.
PointCloud in_lines(double apart_mm, double first_mm) {
  constexpr double kStepMm = 0.5;
  PointCloud lines;
  for (const auto& point : test::FootBody{260.0, kStepMm}.points().positions) {
    const double beyond = std::fmod(point.x() + first_mm + apart_mm, apart_mm);
    if (beyond < kStepMm) lines.positions.push_back(point);
  }
  return lines;
}

/// Where the next line would have been no point tells, be there ever so many on each.
TEST(Redraws, OfAFootInLinesTellWhatLiesBetweenThem) {
  constexpr double kApartMm = 2.0;
  double furthest_off = 0.0;
  for (double first = 0.0; first < kApartMm; first += 0.5) {
    const auto foot = marked(in_lines(kApartMm, first));
    ASSERT_TRUE(foot.lines) << first;
    EXPECT_NEAR(foot.lines->pitch_mm, kApartMm, 0.02);
    Values lengths;
    for (const auto& redrawn : foot.redraws.landmarks) {
      const bool is_marked = redrawn.landmarks.contains("acropodion");
      lengths.push_back(is_marked ? std::optional(length_of(redrawn)) : std::nullopt);
    }
    const double length = foot.landmarks.at("acropodion").position_mm.x();
    const double u95 = u95_by_redraws(length, lengths, foot.redraws.parting).value();
    const double off = std::abs(length - 260.0);
    EXPECT_LT(off, u95) << first;
    EXPECT_LT(u95, 3.0 * kApartMm) << first;
    EXPECT_GT(u95, 0.2 * kApartMm) << first;
    furthest_off = std::max(furthest_off, off);
  }
  EXPECT_GT(furthest_off, 0.3);
}

}  // namespace
}  // namespace instep
