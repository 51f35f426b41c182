#include "core/girth/section/section_evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/circle_contour.h"
#include "tests/support/empty_band.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.35;
constexpr double kNear = 0.05;
constexpr int kCorners = 360;

/// A corner for each degree.
Contour circle() {
  return test::circle_contour(kRadius, kCorners);
}

Vector3d at(double degrees, double radius = kRadius, double height = 0.0) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

/// Along the chords of that many degrees.
double way(double degrees) {
  return degrees * 2.0 * kRadius * std::sin(std::numbers::pi / kCorners);
}

struct Place {
  Vector3d position;
  bool seen = true;
  Vector3d outward = Vector3d::UnitX();
};

SectionEvidence evidence_of(const std::vector<Place>& places) {
  PlaneBand band = test::empty_band();
  for (const auto& place : places) {
    band.points.push_back({place.position, place.outward, 0.0});
    band.seen.push_back(place.seen);
  }
  return evidence_for(band, ContourIndex(circle()), kNear);
}

/// Of skin that leans inwards going up, by that many degrees from upright.
Vector3d leaning(double degrees) {
  const double lean = degrees * std::numbers::pi / 180.0;
  return {std::cos(lean), 0.0, std::sin(lean)};
}

TEST(SectionEvidence, IsNothingWithoutPoints) {
  const auto evidence = evidence_of({});
  EXPECT_EQ(evidence.ways.size(), 0U);
  EXPECT_EQ(evidence.beside, 0U);
  EXPECT_NEAR(evidence.gap, way(360), 1e-12);
  EXPECT_NEAR(evidence.seen_gap, way(360), 1e-12);
}

TEST(SectionEvidence, CountsPointsNearTheContourAndThoseBesideIt) {
  const auto evidence = evidence_of({{at(10)},
                                     {at(20, kRadius + 0.9 * kNear)},
                                     {at(30, kRadius - 0.9 * kNear)},
                                     {at(40, kRadius, 0.9 * kNear)},
                                     {at(50, kRadius, -0.9 * kNear)},
                                     {at(60, kRadius + 1.1 * kNear)},
                                     {at(70, kRadius - 1.1 * kNear)},
                                     {at(80, 0.0)},
                                     {at(90, kRadius, 1.1 * kNear)},
                                     {at(100, kRadius, -1.1 * kNear)},
                                     {at(110, 2.0 * kRadius, 1.1 * kNear)}});
  EXPECT_EQ(evidence.along, 5U);
  EXPECT_EQ(evidence.beside, 3U);
}

TEST(SectionEvidence, LeaningSkinRunsAsideOnItsWayToThePlane) {
  const double up = 0.8 * kNear;
  EXPECT_EQ(evidence_of({{at(10, kRadius - 1.7 * kNear, up), true, leaning(45)},
                         {at(20, kRadius - 2.5 * kNear, up), true, leaning(63.4)},
                         {at(30, kRadius + 3.3 * kNear, -up), true, leaning(80)}})
                .beside,
            0U);
  EXPECT_EQ(evidence_of({{at(10, kRadius - 1.9 * kNear, up), true, leaning(45)},
                         {at(20, kRadius - 1.1 * kNear, up), true, leaning(0)},
                         {at(30, kRadius + 3.5 * kNear, -up), true, leaning(80)},
                         {at(40, kRadius - 1.1 * kNear, 0.0), true, leaning(45)}})
                .beside,
            4U);
}

TEST(SectionEvidence, MeasuresTheLongestWayBetweenPoints) {
  const auto evidence = evidence_of({{at(200)}, {at(20)}, {at(110)}, {at(290)}});
  EXPECT_NEAR(evidence.gap, way(90), 1e-9);
  const auto across_the_start = evidence_of({{at(50)}, {at(170)}, {at(300)}, {at(301)}});
  EXPECT_NEAR(across_the_start.gap, way(130), 1e-9);
  const auto over_the_start = evidence_of({{at(50)}, {at(140)}, {at(230)}, {at(231)}});
  EXPECT_NEAR(over_the_start.gap, way(179), 1e-9);
  EXPECT_NEAR(evidence_of({{at(77)}}).gap, way(360), 1e-9);
}

TEST(SectionEvidence, NoPointBesideTheContourClosesAGap) {
  const auto evidence = evidence_of(
      {{at(0)}, {at(90)}, {at(180)}, {at(230, kRadius + 1.1 * kNear)}, {at(250, 0.35, 0.06)}});
  EXPECT_EQ(evidence.ways.size(), 3U);
  EXPECT_NEAR(evidence.gap, way(180), 1e-9);
}

/// As the back of a heel above the sole that nobody saw.
TEST(SectionEvidence, NoPointOffOnBothCountsClosesAGap) {
  const double off = 0.9 * kNear;
  const auto evidence =
      evidence_of({{at(0)}, {at(60, kRadius, off / 2)}, {at(120, kRadius - off, off)}, {at(240)}});
  EXPECT_EQ(evidence.along, 4U);
  EXPECT_EQ(evidence.ways.size(), 3U);
  EXPECT_NEAR(evidence.gap, way(180), 1e-6);
}

TEST(SectionEvidence, TellsTheWaysToItsPointsInOrder) {
  const auto ways = evidence_of({{at(200)}, {at(20), false}, {at(110, 0.1)}, {at(290)}}).ways;
  ASSERT_EQ(ways.size(), 3U);
  EXPECT_NEAR(ways[0], way(20), 1e-9);
  EXPECT_NEAR(ways[1], way(200), 1e-9);
  EXPECT_NEAR(ways[2], way(290), 1e-9);
}

TEST(SectionEvidence, TellsPointsThatNoCameraSawApart) {
  const auto evidence = evidence_of({{at(0)}, {at(90), false}, {at(180)}, {at(270)}});
  EXPECT_EQ(evidence.ways.size(), 4U);
  EXPECT_NEAR(evidence.gap, way(90), 1e-9);
  EXPECT_NEAR(evidence.seen_gap, way(180), 1e-9);
  const auto unseen = evidence_of({{at(0), false}, {at(180), false}});
  EXPECT_NEAR(unseen.gap, way(180), 1e-9);
  EXPECT_NEAR(unseen.seen_gap, way(360), 1e-9);
}

}  // namespace
}  // namespace instep
