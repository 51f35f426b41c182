#include "core/foot/measuring_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "core/foot/measures/foot_tapes.h"
#include "core/girth/girth.h"
#include "tests/support/foot_body.h"

namespace instep {
namespace {

using test::FootBody;

constexpr double kLength = 260.0;

FootScan measured_by(const MeasuringRules& rules, PointCloud cloud = FootBody{}.points()) {
  AlignmentOptions options;
  options.rules = rules;
  return align_foot(cloud, options).and_then(find_landmarks).value();
}

FootScan along(AxisRule axis, PointCloud cloud = FootBody{}.points()) {
  MeasuringRules rules;
  rules.axis = axis;
  return measured_by(rules, std::move(cloud));
}

/// How the foot's axis runs in the frame of the body, whose medial side is +y.
double bearing_deg(const FootScan& foot) {
  const Eigen::Vector3d axis = foot.foot_from_input.linear().transpose() * Eigen::Vector3d::UnitX();
  return std::atan2(axis.y(), axis.x()) * 180.0 / std::numbers::pi;
}

double degrees(double slope) {
  return std::atan(slope) * 180.0 / std::numbers::pi;
}

double value_of(const FootScan& foot, const char* id) {
  return measure_foot(foot).value().find(id)->value_mm;
}

TEST(AxisRule, IsTheSecondToesByDefault) {
  EXPECT_EQ(MeasuringRules{}.axis, AxisRule::kSecondToe);
  EXPECT_EQ(bearing_deg(along(AxisRule::kSecondToe)),
            bearing_deg(align_foot(FootBody{}.points()).value()));
}

TEST(AxisRule, OfBrannockRunsAlongARulerOnTheMedialSide) {
  // The ruler touches at the two places between which the border is furthest from a line: by brute
  // force the greatest slope from any place of the heel that leaves the border on one side.
  const FootBody body;
  double steepest = -1.0;
  for (double heel = 5.0; heel < 0.35 * kLength; heel += 0.25) {
    for (double ball = 0.6 * kLength; ball < 0.8 * kLength; ball += 0.25) {
      const double slope = (body.medial_border(ball) - body.medial_border(heel)) / (ball - heel);
      bool is_outside = true;
      for (double x = 5.0; x < 0.8 * kLength && is_outside; x += 1.0) {
        is_outside = body.medial_border(x) < body.medial_border(heel) + slope * (x - heel) + 1e-2;
      }
      if (is_outside) steepest = std::max(steepest, slope);
    }
  }
  EXPECT_NEAR(bearing_deg(along(AxisRule::kMedialTangent)), degrees(steepest), 0.3);
}

TEST(AxisRule, OfTheOutlineIsItsPrincipalAxis) {
  const FootBody body;
  double area = 0.0, x1 = 0.0, y1 = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (double x = 0.25; x < kLength; x += 0.5) {
    const double top = body.medial_border(x), low = -body.lateral_border(x);
    area += top - low;
    x1 += x * (top - low);
    y1 += (top * top - low * low) / 2.0;
    xx += x * x * (top - low);
    xy += x * (top * top - low * low) / 2.0;
    yy += (top * top * top - low * low * low) / 3.0;
  }
  const double sxx = xx - x1 * x1 / area, syy = yy - y1 * y1 / area, sxy = xy - x1 * y1 / area;
  const double angle = 0.5 * std::atan2(2.0 * sxy, sxx - syy) * 180.0 / std::numbers::pi;
  // That of the convex hull: the hollow of the arch counts as covered.
  EXPECT_NEAR(bearing_deg(along(AxisRule::kOutline)), angle, 0.5);
}

TEST(AxisRule, OfTheHeelRunsThroughItsMiddles) {
  const FootBody body;
  const auto middle = [&](double x) {
    return 0.5 * (body.medial_border(x) - body.lateral_border(x));
  };
  const double slope = (middle(0.13 * kLength) - middle(0.03 * kLength)) / (0.10 * kLength);
  EXPECT_NEAR(bearing_deg(along(AxisRule::kHeelCentre)), degrees(slope), 1.0);
}

TEST(AxisRule, OfTheBallRunsToItsCentre) {
  const auto foot = along(AxisRule::kBallCentre);
  const auto& tibiale = foot.landmarks.at("metatarsale_tibiale").position_mm;
  const auto& fibulare = foot.landmarks.at("metatarsale_fibulare").position_mm;
  EXPECT_NEAR((tibiale + fibulare).y() / 2.0, 0.0, 0.3);
  EXPECT_GT(std::abs(bearing_deg(foot) - bearing_deg(along(AxisRule::kSecondToe))), 0.5);
}

TEST(AxisRule, IsTheSameInAMirrorAndInRedraws) {
  for (const auto& [name, axis] : kAxisRules) {
    SCOPED_TRACE(name);
    const auto right = along(axis);
    const auto left = along(axis, test::mirrored(FootBody{}.points()));
    EXPECT_EQ(left.side, Side::kLeft);
    EXPECT_NEAR(bearing_deg(left), -bearing_deg(right), 0.05);
    EXPECT_EQ(right.rules.axis, axis);
    ASSERT_FALSE(right.redraws.landmarks.empty());
    for (const auto& redrawn : right.redraws.landmarks) {
      const Eigen::Vector3d turned = redrawn.foot_from_redrawn.linear() * Eigen::Vector3d::UnitX();
      EXPECT_NEAR(turned.y(), 0.0, 0.02);
    }
  }
}

TEST(AxisRule, IsNamedInTheDefinition) {
  for (const auto& [name, axis] : kAxisRules) {
    const auto set = measure_foot(along(axis)).value();
    EXPECT_NE(set.find("foot_length")->definition.find(name), std::string::npos);
  }
}

TEST(BallGirthRule, ShortestIsShorterThanAnyTapeNearIt) {
  MeasuringRules rules;
  rules.ball_girth = BallGirthRule::kShortest;
  const auto foot = measured_by(rules);
  const double shortest = value_of(foot, "ball_girth");
  double least = 1e300;
  for (double lean = -20.0; lean <= 20.0; lean += 4.0) {
    const auto tape = leaning_ball_tape(foot.landmarks, lean).value();
    least = std::min(least, girth_by_rbf(foot.cloud, tape, {}).value().stretched_mm);
  }
  EXPECT_NEAR(shortest, least, 0.3);
  EXPECT_LT(shortest, value_of(measured_by({}), "ball_girth"));
}

TEST(BallGirthRule, LeaningByNothingIsUpright) {
  const auto foot = measured_by({});
  const auto upright = ball_tape(foot.landmarks).value();
  const auto leaning = leaning_ball_tape(foot.landmarks, 0.0).value();
  EXPECT_NEAR(std::abs(upright.normal().dot(leaning.normal())), 1.0, 1e-9);
  EXPECT_NEAR(upright.distance(leaning.origin()), 0.0, 1e-9);
}

TEST(InstepGirthRule, UprightIsSquareToTheAxisAtHalfTheLength) {
  MeasuringRules rules;
  rules.instep_girth = InstepGirthRule::kUpright;
  const auto set = measure_foot(measured_by(rules)).value();
  const auto& plane = *set.find("instep_girth")->plane;
  EXPECT_NEAR(std::abs(plane.normal().x()), 1.0, 1e-9);
  EXPECT_NEAR(plane.origin().x(), 0.5 * set.find("foot_length")->value_mm, 1.0);
}

TEST(HeelBreadthRule, TakesTheBreadthAtItsPlace) {
  const FootBody body;
  const auto breadth = [&](double x) { return body.medial_border(x) + body.lateral_border(x); };
  double widest = 0.0;
  for (double x = 0.0; x <= 0.2 * kLength; x += 0.5) widest = std::max(widest, breadth(x));
  const auto by = [](HeelBreadthRule rule) {
    MeasuringRules rules;
    rules.heel_breadth = rule;
    return value_of(measured_by(rules), "heel_breadth");
  };
  EXPECT_NEAR(by(HeelBreadthRule::kSixth), breadth(kLength / 6.0), 0.5);
  EXPECT_NEAR(by(HeelBreadthRule::kFortyMm), breadth(40.0), 0.5);
  EXPECT_NEAR(by(HeelBreadthRule::kWidestFifth), widest, 0.5);
}

/// Value and definition of every measure but one.
std::map<std::string, std::string> others_than(const std::string& id, const MeasuringRules& rules) {
  std::map<std::string, std::string> others;
  const auto set = measure_foot(measured_by(rules)).value();
  for (const auto& measure : set.measures) {
    if (measure.id == id) continue;
    const double value = std::isnan(measure.value_mm) ? *measure.value_deg : measure.value_mm;
    others[measure.id] = std::to_string(value) + " " + measure.definition;
  }
  return others;
}

TEST(MeasuringRules, LeaveMeasuresThatTheyDoNotNameAsTheyAre) {
  MeasuringRules ball;
  ball.ball_girth = BallGirthRule::kShortest;
  EXPECT_EQ(others_than("ball_girth", ball), others_than("ball_girth", {}));
  MeasuringRules instep;
  instep.instep_girth = InstepGirthRule::kUpright;
  EXPECT_EQ(others_than("instep_girth", instep), others_than("instep_girth", {}));
  const auto by_sixth = others_than("heel_breadth", {});
  EXPECT_TRUE(by_sixth.contains("toe1_angle") && by_sixth.contains("toe5_angle"));
  for (const auto rule : {HeelBreadthRule::kFortyMm, HeelBreadthRule::kWidestFifth}) {
    MeasuringRules heel;
    heel.heel_breadth = rule;
    EXPECT_EQ(others_than("heel_breadth", heel), by_sixth);
  }
}

/// The heel lifted by 31 mm, as in a shoe: nothing of it is within 25 mm of the floor.
PointCloud on_a_raised_heel() {
  PointCloud cloud = FootBody{}.points();
  for (auto& point : cloud.positions) {
    point.z() += 0.2 * std::max(0.0, 0.6 * kLength - point.x());
  }
  return cloud;
}

TEST(AxisRule, GivesWayToTheSecondToesWithAWarning) {
  for (const auto axis : {AxisRule::kMedialTangent, AxisRule::kHeelCentre}) {
    AlignmentOptions options;
    options.rules.axis = axis;
    options.up = Eigen::Vector3d::UnitZ();
    const auto foot = align_foot(on_a_raised_heel(), options).value();
    EXPECT_EQ(foot.rules.axis, AxisRule::kSecondToe);
    const std::string warning =
        "the axis " + std::string(name_of(axis, kAxisRules)) + " was not found: pt_toe2 is used";
    EXPECT_EQ(std::count(foot.warnings.begin(), foot.warnings.end(), warning), 1);
  }
}

bool tells_of_choice(const FootScan& foot) {
  return std::any_of(foot.warnings.begin(), foot.warnings.end(), [](const auto& warning) {
    return warning.find("of one's own choice") != std::string::npos;
  });
}

/// An axis that gave way to another one was taken for a choice.
TEST(AxisRule, IsToldOfAsAChoiceOnlyWhereItIsOne) {
  const PointCloud whole = FootBody{}.points();
  std::vector<std::size_t> few;
  for (std::size_t i = 0; i < whole.size(); i += whole.size() / 300) few.push_back(i);
  const auto gave_way = align_foot(whole.subset(few)).and_then(find_landmarks).value();
  ASSERT_NE(gave_way.rules, MeasuringRules{});
  EXPECT_FALSE(tells_of_choice(gave_way));
  AlignmentOptions options;
  options.rules.axis = AxisRule::kMedialTangent;
  EXPECT_TRUE(tells_of_choice(align_foot(whole, options).and_then(find_landmarks).value()));
}

TEST(AxisRule, ThatIsNotFoundAgainLeavesTheFootAlone) {
  AlignmentOptions options;
  options.rules.axis = AxisRule::kMedialTangent;
  auto foot = align_foot(FootBody{}.points(), options).value();
  ASSERT_EQ(foot.rules.axis, AxisRule::kMedialTangent);
  EXPECT_TRUE(realign(foot));
  std::erase_if(foot.cloud.positions,
                [](const auto& point) { return point.x() < 0.35 * kLength && point.z() < 27.0; });
  foot.cloud.normals.clear();
  foot.cloud.origins.clear();
  const RigidTransform before = foot.foot_from_input;
  EXPECT_FALSE(realign(foot));
  EXPECT_TRUE(foot.foot_from_input.isApprox(before, 1e-15));
}

}  // namespace
}  // namespace instep
