#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/foot/alignment.h"
#include "tests/support/real_feet.h"

namespace instep {
namespace {

using test::measured;
using test::without;

/// Real feet of which a part is missing.
class CutFeet : public test::RealFeet {};

/// Their heights were as much too low as was cut off, their girths by half of it.
TEST_F(CutFeet, CutOffOverTheFloorHaveTheirHeightsAndGirths) {
  for (const char* name : {"retail_left.stl", "retail_right.stl"}) {
    const auto points = cloud(name, 1000.0);
    const auto whole = measured(points);
    const auto lowest = std::min_element(
        points.positions.begin(), points.positions.end(),
        [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.z() < b.z(); });
    for (const double cut_mm : {2.0, 4.0, 6.0}) {
      const auto cut = measured(without(
          points, [&](const Eigen::Vector3d& point) { return point.z() <= lowest->z() + cut_mm; }));
      for (const char* id : {"instep_height", "ball_height", "toe1_height", "ball_girth",
                             "waist_girth", "instep_girth", "ankle_girth"}) {
        const Measure* measure = cut.set.find(id);
        ASSERT_NE(measure, nullptr) << name << " " << cut_mm << " " << id;
        EXPECT_NEAR(measure->value_mm, whole.set.find(id)->value_mm, *measure->u95_mm)
            << name << " " << cut_mm << " " << id;
      }
    }
  }
}

/// The rim of a hole was taken for the foot's back, its ball or its toe: the instep 49 mm high
/// instead of 74, give or take two.
TEST_F(CutFeet, WithAHoleTellNothingWrong) {
  for (const char* name : {"retail_left.stl", "retail_right.stl"}) {
    const auto points = cloud(name, 1000.0);
    const auto whole = measured(points);
    std::size_t told = 0;
    for (const char* place :
         {"instep_point", "ball_top", "metatarsale_tibiale", "metatarsale_fibulare", "toe1_tip",
          "toe1_top", "toe5_contact", "heel_point", "heel_breadth_medial", "heel_breadth_lateral",
          "medial_malleolus"}) {
      const Eigen::Vector3d middle =
          whole.foot.foot_from_input.inverse() * whole.foot.landmarks.at(place).position_mm;
      for (const double radius : {20.0, 30.0}) {
        SCOPED_TRACE(testing::Message() << name << " " << place << " " << radius);
        const auto holed = measured(without(points, [&](const Eigen::Vector3d& point) {
          return (point - middle).norm() < radius;
        }));
        EXPECT_EQ(holed.foot.side, whole.foot.side);
        for (const auto& measure : holed.set.measures) {
          const Measure* truth = whole.set.find(measure.id);
          if (truth == nullptr) continue;
          ++told;
          const double doubt = std::hypot(measure.u95().value(), truth->u95().value());
          EXPECT_NEAR(measure.value(), truth->value(), 1.5 * doubt) << measure.id;
        }
      }
    }
    EXPECT_GT(told, 0U);
  }
}

/// The rim of what was left was taken for a border: a left foot was a right one, 93 % sure, and 88
/// mm broad instead of 112.
TEST_F(CutFeet, CutOffBesideTheirAxisAreNotSurelyOfTheOtherSide) {
  for (const auto& [name, unit_mm] : std::map<const char*, double>{
           {"retail_left.stl", 1000.0}, {"retail_right.stl", 1000.0}, {"lab_left.ply", 1.0}}) {
    const auto points = cloud(name, unit_mm);
    const auto whole = measured(points);
    EXPECT_TRUE(whole.foot.is_side_sure());
    for (const double sign : {1.0, -1.0}) {
      for (const double kept_mm : {30.0, 35.0, 40.0}) {
        const auto cut = align_foot(without(points, [&](const Eigen::Vector3d& point) {
          return sign * (whole.foot.foot_from_input * point).y() > kept_mm;
        }));
        const bool is_wrong = cut && cut->side != whole.foot.side;
        EXPECT_FALSE(is_wrong && cut->is_side_sure()) << name << " " << sign * kept_mm;
      }
    }
  }
}

/// With some millimetres of the first toe cut off, the foremost skin was the second one's, and the
/// foot up to 8 mm too short in 1.5.
TEST_F(CutFeet, WithoutTheTipOfTheFirstToeMayBeLonger) {
  for (const auto& [name, unit_mm] :
       std::map<const char*, double>{{"retail_left.stl", 1000.0}, {"lab_left.ply", 1.0}}) {
    const auto points = cloud(name, unit_mm);
    const auto whole = measured(points);
    const double length = whole.set.find("foot_length")->value_mm;
    EXPECT_TRUE(whole.set.find("foot_length")->warnings.empty()) << name;
    for (const double cut_mm : {4.0, 5.0, 6.0, 7.0, 8.0}) {
      const auto cut = measured(without(points, [&](const Eigen::Vector3d& point) {
        return (whole.foot.foot_from_input * point).x() > length - cut_mm;
      }));
      const Measure* left = cut.set.find("foot_length");
      ASSERT_NE(left, nullptr) << name << " " << cut_mm;
      EXPECT_NEAR(left->value_mm, length, *left->u95_mm) << name << " " << cut_mm;
      EXPECT_FALSE(left->warnings.empty()) << name << " " << cut_mm;
    }
  }
}

/// The toes over the cut were taken for a floor round the foot, which was 90 mm too short in 10.
TEST_F(CutFeet, CutOffAboveTheirEdgeAreRefused) {
  for (const auto& [name, unit_mm] : std::map<const char*, double>{
           {"retail_left.stl", 1000.0}, {"retail_right.stl", 1000.0}, {"lab_left.ply", 1.0}}) {
    const auto points = cloud(name, unit_mm);
    const auto whole = measured(points);
    for (const double cut_mm : {15.0, 20.0, 25.0, 30.0, 40.0}) {
      const auto cut = align_foot(without(points, [&](const Eigen::Vector3d& point) {
        return (whole.foot.foot_from_input * point).z() < cut_mm;
      }));
      ASSERT_FALSE(cut) << name << " " << cut_mm;
      EXPECT_EQ(cut.error().code, ErrorCode::kInsufficientData) << cut.error().line();
      EXPECT_NE(cut.error().message.find("lowest part"), std::string::npos) << cut.error().line();
    }
  }
}

}  // namespace
}  // namespace instep
