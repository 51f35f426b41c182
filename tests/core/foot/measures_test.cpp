#include "core/foot/measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/geometry/polygon.h"
#include "tests/support/foot_body.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::FootBody;

FootScan prepared(const PointCloud& cloud) {
  const auto foot = align_foot(cloud).and_then(find_landmarks);
  if (!foot) throw std::runtime_error(foot.error().line());
  return *foot;
}

Result<Girth> no_girth(const PointCloud&, const TapePlane&, const GirthOptions&) {
  return fail(ErrorCode::kInsufficientData, "the section is open", "scan again");
}

double value(const MeasureSet& set, const char* id) {
  return set.find(id)->value_mm;
}

/// Tape round the body itself: hull of a very thin slice of a very dense cloud.
double dense_tape(const FootScan& foot, const TapePlane& tape) {
  const auto in_input = tape.transformed(foot.foot_from_input.inverse());
  std::vector<Eigen::Vector2d> slice;
  for (const auto& point : FootBody{260.0, 0.35}.points().positions) {
    if (std::abs(in_input.distance(point)) < 0.3) slice.push_back(in_input.project(point));
  }
  return perimeter(convex_hull(std::move(slice)));
}

TEST(Measures, AgreeWithTheBody) {
  const auto foot = prepared(FootBody{}.points());
  const auto set = measure_foot(foot);
  ASSERT_TRUE(set) << set.error().line();
  double most = -1e300;
  double least = 1e300;
  for (const auto& point : foot.cloud.positions) {
    if (point.x() < 130.0 || point.x() > 0.85 * 260.0 || point.z() > 25.0) continue;
    most = std::max(most, point.y());
    least = std::min(least, point.y());
  }
  // The body's walls have a kink at their widest, which a smooth surface rounds by some tenths to
  // each side.
  EXPECT_NEAR(value(*set, "foot_breadth_horizontal"), most - least, 0.6);
  for (const char* id : {"ball_girth", "waist_girth", "instep_girth"}) {
    const auto* measure = set->find(id);
    ASSERT_NE(measure, nullptr) << id;
    EXPECT_NEAR(measure->value_mm, dense_tape(foot, *measure->plane), 1.0) << id;
    EXPECT_EQ(measure->value_mm, measure->girth->stretched_mm);
    EXPECT_FALSE(measure->definition.empty());
  }
}

Result<Girth> some_girth(const PointCloud&, const TapePlane&, const GirthOptions&) {
  Girth girth;
  girth.stretched_mm = girth.contact_mm = 200.0;
  return girth;
}

bool is_same_plane(const TapePlane& a, const TapePlane& b) {
  const auto points = a.control_points();
  return std::all_of(points.begin(), points.end(),
                     [&](const Vector3d& point) { return std::abs(b.distance(point)) < 1e-9; });
}

/// A tape hangs on just those landmarks whose move moves it, and warns of just those.
TEST(Measures, WarnOfEachDoubtfulLandmarkThatTheirTapeHangsOn) {
  const auto foot = prepared(FootBody{}.points());
  const auto frame = align_foot(FootBody{}.points()).value().landmarks;
  MeasureOptions options;
  options.girth = some_girth;
  const auto set = measure_foot(foot, options).value();
  int warned = 0;
  for (const auto& [name, landmark] : foot.landmarks) {
    if (frame.count(name) > 0) continue;
    auto moved = foot;
    moved.landmarks[name].position_mm += Vector3d(3.0, 2.0, 4.0);
    moved.landmarks[name].confidence = 0.3;
    const auto other = measure_foot(moved, options).value();
    for (const auto& measure : set.measures) {
      const auto* now = other.find(measure.id);
      if (!measure.plane || now == nullptr) continue;
      const bool warns = std::find(now->warnings.begin(), now->warnings.end(),
                                   name + " is placed by proportion") != now->warnings.end();
      EXPECT_EQ(warns, !is_same_plane(*measure.plane, *now->plane)) << measure.id << ", " << name;
      warned += warns;
    }
  }
  EXPECT_GT(warned, 8);
}

TEST(Measures, KnowWhatMovesAllRedrawsOfALandmark) {
  auto foot = prepared(FootBody{}.points());
  auto& heel = foot.landmarks.at("heel_point");
  heel.deviations_off_mm.clear();
  const auto sure = measure_foot(foot).value();
  heel.deviations_off_mm = {Vector3d(-1.0, 0.0, 2.5)};
  const auto unsure = measure_foot(foot).value();
  auto moved = foot;
  moved.landmarks.at("heel_point").position_mm += heel.deviations_off_mm.front();
  const auto elsewhere = measure_foot(moved).value();
  int hanging = 0;
  for (const auto& measure : sure.measures) {
    const auto* now = unsure.find(measure.id);
    ASSERT_NE(now, nullptr) << measure.id;
    const bool hangs = measure.id == "short_heel_girth" || measure.id == "long_heel_girth";
    ASSERT_TRUE(measure.parts && now->parts) << measure.id;
    const double more =
        std::sqrt(std::pow(now->parts->landmarks, 2) - std::pow(measure.parts->landmarks, 2));
    const double moves = std::abs(elsewhere.find(measure.id)->value() - measure.value());
    EXPECT_NEAR(more, hangs ? 1.96 * moves : 0.0, 0.4 + measure.parts->surface) << measure.id;
    if (hangs) {
      ++hanging;
      EXPECT_GT(more, 0.8) << measure.id;
    }
  }
  EXPECT_GT(hanging, 0);
}

TEST(Measures, OfLengthKnowWhatMovesAllRedrawsOfALandmark) {
  auto foot = prepared(FootBody{}.points());
  auto& tibiale = foot.landmarks.at("metatarsale_tibiale");
  auto& top = foot.landmarks.at("ball_top");
  ASSERT_TRUE(tibiale.deviations_off_mm.empty());
  const auto sure = measure_foot(foot).value();
  tibiale.deviations_off_mm = {Vector3d(3.0, 0.0, 0.0), Vector3d(4.0, 2.0, 0.0)};
  top.deviations_off_mm = {Vector3d(0.0, 0.0, 1.5)};
  const auto unsure = measure_foot(foot).value();
  const auto more = [&](const char* id) {
    return std::sqrt(std::pow(unsure.find(id)->u95().value(), 2) -
                     std::pow(sure.find(id)->u95().value(), 2));
  };
  EXPECT_NEAR(more("ball_length"), 1.96 * 5.0, 0.01);
  EXPECT_NEAR(more("ball_height"), 1.96 * 1.5, 0.01);
  EXPECT_GT(more("foot_breadth"), 1.96 * 1.5);
  EXPECT_EQ(more("foot_length"), 0.0);
}

// Measured: at most 0.12 mm, of the long heel girth, whose interval is +- 0.6: it crosses the kink
// of the body's walls, and patches start elsewhere in a mirror.
TEST(Measures, OfALeftFootAreThoseOfItsMirrorImage) {
  const auto right = measure_foot(prepared(FootBody{}.points()));
  const auto left = measure_foot(prepared(test::mirrored(FootBody{}.points())));
  ASSERT_TRUE(right && left);
  ASSERT_EQ(left->measures.size(), right->measures.size());
  for (const auto& measure : right->measures) {
    EXPECT_NEAR(left->find(measure.id)->value(), measure.value(), 0.15) << measure.id;
  }
}

TEST(Measures, HardlyMoveWhenHalfThePointsAreMissing) {
  const auto whole = measure_foot(prepared(FootBody{}.points()));
  const auto half = measure_foot(prepared(test::half_of(FootBody{}.points())));
  ASSERT_TRUE(whole && half);
  for (const auto& measure : whole->measures) {
    const Measure* of_half = half->find(measure.id);
    if (of_half == nullptr) continue;
    const double doubt = std::hypot(measure.u95().value_or(0.0), of_half->u95().value_or(0.0));
    EXPECT_NEAR(of_half->value(), measure.value(), std::max(1.0, 1.5 * doubt)) << measure.id;
  }
}

TEST(Measures, WithholdAGirthThatCannotBeHad) {
  MeasureOptions options;
  options.girth = no_girth;
  const auto set = measure_foot(prepared(FootBody{}.points()), options);
  ASSERT_TRUE(set);
  for (const auto& measure : set->measures) EXPECT_FALSE(measure.girth) << measure.id;
  for (const char* id : {"ball_girth", "waist_girth", "instep_girth", "long_heel_girth"}) {
    EXPECT_EQ(set->find(id), nullptr) << id;
    const auto withheld =
        std::find_if(set->withheld.begin(), set->withheld.end(),
                     [name = id](const WithheldMeasure& one) { return one.id == name; });
    ASSERT_NE(withheld, set->withheld.end()) << id;
    EXPECT_NE(withheld->reason.find("the section is open"), std::string::npos) << id;
  }
}

/// As between two feet: nobody saw the medial side below a height.
FootScan with_hidden_side(FootScan foot, double below_mm) {
  foot.cloud.origins.clear();
  for (const auto& point : foot.cloud.positions) {
    const bool is_hidden = point.z() < below_mm && (point.y() > 0.0 || point.z() < 1.0);
    foot.cloud.origins.push_back(is_hidden ? PointOrigin::kPlatform : PointOrigin::kSeen);
  }
  return foot;
}

TEST(Measures, WithholdAGirthWhoseWallWasHardlySeen) {
  const auto foot = prepared(FootBody{}.points());
  const auto reason = [&](double below_mm) -> std::string {
    const auto set = measure_foot(with_hidden_side(foot, below_mm));
    if (!set) return set.error().line();
    for (const auto& one : set->withheld) {
      if (one.id == "instep_girth") return one.reason;
    }
    return "";
  };
  EXPECT_EQ(reason(10.0), "");
  const std::string high = reason(0.8 * foot.landmarks.at("instep_point").position_mm.z());
  EXPECT_NE(high.find("most of the way down"), std::string::npos) << high;
  EXPECT_NE(high.find("one foot alone"), std::string::npos) << high;
}

TEST(Measures, KnowWhatAllRedrawsAreOffBy) {
  MeasureOptions options;
  options.girth = no_girth;
  FootScan foot = prepared(FootBody{}.points());
  const double u95 = measure_foot(foot, options)->find("foot_breadth_horizontal")->u95_mm.value();
  ASSERT_LT(u95, 2.0);
  for (auto& redrawn : foot.redraws.landmarks) {
    redrawn.landmarks.at("ball_medial").position_mm.y() -= 9.0;
  }
  const auto set = measure_foot(foot, options);
  ASSERT_TRUE(set);
  EXPECT_NEAR(set->find("foot_breadth_horizontal")->u95_mm.value(), 9.0, 1.0);
}

/// Redraws in which it is under the least that is told are no less possible.
TEST(Measures, OfAnArchKnowTheRedrawsThatFindItFlat) {
  MeasureOptions options;
  options.girth = no_girth;
  FootScan foot = prepared(FootBody{}.points());
  Landmark arch;
  arch.position_mm = {120.0, 20.0, 3.6};
  foot.landmarks["arch_point"] = arch;
  double sign = 1.0;
  for (auto& redrawn : foot.redraws.landmarks) {
    redrawn.landmarks["arch_point"] = arch;
    redrawn.landmarks["arch_point"].position_mm.z() += sign;
    sign = -sign;
  }
  const auto told = measure_foot(foot, options);
  ASSERT_TRUE(told);
  ASSERT_NE(told->find("arch_height"), nullptr);
  EXPECT_GT(told->find("arch_height")->u95_mm.value(), 1.0);
  foot.landmarks["arch_point"].position_mm.z() = 2.5;
  const auto flat = measure_foot(foot, options);
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->find("arch_height"), nullptr);
}

/// The heel's medial point scatters over the redraws, as where two feet stand close together.
TEST(Measures, WithholdWhatNoDecisionCouldRestOn) {
  MeasureOptions options;
  options.girth = no_girth;
  const auto foot = prepared(FootBody{}.points());
  const auto with_scatter = [&](double scatter_mm) {
    FootScan scattered = foot;
    double sign = 1.0;
    for (auto& redrawn : scattered.redraws.landmarks) {
      redrawn.landmarks.at("heel_breadth_medial").position_mm.y() += sign * scatter_mm;
      sign = -sign;
    }
    return measure_foot(scattered, options);
  };
  const auto useful = with_scatter(0.5);
  ASSERT_TRUE(useful);
  ASSERT_NE(useful->find("heel_breadth"), nullptr);
  const auto useless = with_scatter(30.0);
  ASSERT_TRUE(useless);
  EXPECT_EQ(useless->find("heel_breadth"), nullptr);
  const auto withheld =
      std::find_if(useless->withheld.begin(), useless->withheld.end(),
                   [](const WithheldMeasure& one) { return one.id == "heel_breadth"; });
  ASSERT_NE(withheld, useless->withheld.end());
  EXPECT_NE(withheld->reason.find("told to no better than +-"), std::string::npos);
  EXPECT_EQ(useless->measures.size() + 1, useful->measures.size());
}

/// As where no redraw on points moved by them still shows a foot.
TEST(Measures, SayWhereLocalErrorsHideTheLandmarks) {
  MeasureOptions options;
  options.girth = no_girth;
  FootScan foot = prepared(FootBody{}.points());
  foot.redraws.erring.resize(foot.redraws.landmarks.size());
  const auto set = measure_foot(foot, options);
  ASSERT_TRUE(set) << set.error().line();
  EXPECT_TRUE(set->measures.empty());
  for (const auto& one : set->withheld) {
    if (one.id != "foot_length") continue;
    EXPECT_NE(one.reason.find("calibrate the depths"), std::string::npos) << one.reason;
  }
}

/// As where the cloud has one side of the heel alone.
TEST(Measures, WithholdTheBreadthOfASliverOfAHeel) {
  MeasureOptions options;
  options.girth = no_girth;
  FootScan foot = prepared(FootBody{}.points());
  const Vector3d medial = foot.landmarks.at("heel_breadth_medial").position_mm;
  foot.landmarks.at("heel_breadth_lateral").position_mm = medial - Vector3d(0.0, 12.0, 0.0);
  const auto set = measure_foot(foot, options);
  ASSERT_TRUE(set) << set.error().line();
  EXPECT_EQ(set->find("heel_breadth"), nullptr);
  const auto withheld =
      std::find_if(set->withheld.begin(), set->withheld.end(),
                   [](const WithheldMeasure& one) { return one.id == "heel_breadth"; });
  ASSERT_NE(withheld, set->withheld.end());
  EXPECT_NE(withheld->reason.find("too narrow"), std::string::npos) << withheld->reason;
}

/// The rest does not hang on the length's interval, and a toe's angle has a limit of its own.
TEST(Measures, WithholdEvenALengthOrAnAngleThatIsUseless) {
  MeasureOptions options;
  options.girth = no_girth;
  FootScan foot = prepared(FootBody{}.points());
  double sign = 1.0;
  for (auto& redrawn : foot.redraws.landmarks) {
    redrawn.landmarks.at("acropodion").position_mm.x() += 100.0 * sign;
    redrawn.landmarks.at("toe1_contact").position_mm.y() += 40.0 * sign;
    sign = -sign;
  }
  const auto set = measure_foot(foot, options);
  ASSERT_TRUE(set) << set.error().line();
  EXPECT_NE(set->find("foot_breadth"), nullptr);
  for (const auto& [id, unit] : {std::pair("foot_length", " mm"), {"toe1_angle", " degrees"}}) {
    EXPECT_EQ(set->find(id), nullptr) << id;
    const auto withheld =
        std::find_if(set->withheld.begin(), set->withheld.end(),
                     [name = id](const WithheldMeasure& one) { return one.id == name; });
    ASSERT_NE(withheld, set->withheld.end()) << id;
    EXPECT_NE(withheld->reason.find(unit), std::string::npos) << withheld->reason;
  }
}

TEST(Measures, WithholdWhatHangsOnAMissingLandmark) {
  auto foot = prepared(FootBody{}.points());
  foot.landmarks.erase("medial_arch");
  const auto set = measure_foot(foot);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->find("waist_girth"), nullptr);
  EXPECT_EQ(set->find("instep_girth"), nullptr);
  EXPECT_NE(set->find("ball_girth"), nullptr);
}

TEST(Measures, AreGivenUpWhenToldSoAfterAnyOne) {
  const auto foot = prepared(FootBody{}.points());
  for (std::size_t k = 1; k <= 6; ++k) {
    std::size_t asked = 0;
    const auto set = measure_foot(foot, {}, [&] { return ++asked < k; });
    ASSERT_FALSE(set) << k;
    EXPECT_EQ(set.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(asked, k);
  }
}

TEST(Measures, RefuseAFootWithoutLandmarks) {
  const auto set = measure_foot(FootScan{});
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().code, ErrorCode::kInvalidInput);
}

TEST(Measures, WithoutAnInstepAreThoseThatDoNotHangOnIt) {
  const auto foot = prepared(FootBody{}.points());
  const auto whole = measure_foot(foot);
  ASSERT_TRUE(whole) << whole.error().line();
  FootScan unseen = foot;
  unseen.landmarks.erase("instep_point");
  const auto set = measure_foot(unseen);
  ASSERT_TRUE(set) << set.error().line();
  for (const char* id : {"instep_height", "instep_girth", "waist_girth", "long_heel_girth"}) {
    ASSERT_NE(whole->find(id), nullptr) << id;
    EXPECT_EQ(set->find(id), nullptr) << id;
    const auto reason = std::find_if(set->withheld.begin(), set->withheld.end(),
                                     [&](const auto& withheld) { return withheld.id == id; });
    ASSERT_NE(reason, set->withheld.end()) << id;
    EXPECT_NE(reason->reason.find("instep_point was not found: scan"), std::string::npos)
        << reason->reason;
  }
  for (const char* id : {"foot_length", "ball_girth", "heel_breadth"}) {
    ASSERT_NE(set->find(id), nullptr) << id;
    EXPECT_EQ(set->find(id)->value_mm, whole->find(id)->value_mm) << id;
  }
}

TEST(Measures, AreRefusedOfAFootThatIsNotAligned) {
  auto foot = prepared(FootBody{}.points());
  foot.landmarks.erase("pternion");
  const auto unaligned = measure_foot(foot);
  ASSERT_FALSE(unaligned);
  EXPECT_EQ(unaligned.error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace instep
