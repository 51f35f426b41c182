#include "core/girth/section/section_neck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;

Contour contour_through(const std::vector<Vector2d>& corners) {
  Contour contour{corners, {}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d along = corners[contour.next(i)] - corners[i];
    contour.outward.push_back(Vector2d(along.y(), -along.x()).normalized());
  }
  return contour;
}

/// Counter-clockwise on a circle, from one angle to another.
void add_arc(Vector2d middle, double radius, double from, double to, std::vector<Vector2d>& line) {
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    const double at = from + (to - from) * i / kSteps;
    line.push_back(middle + radius * Vector2d(std::cos(at), std::sin(at)));
  }
}

/// Round two discs that overlap, whose outlines cross `neck` apart.
Contour round_two_discs(double radius, double other, double neck) {
  const double half = 0.5 * neck;
  const double angle = std::asin(half / radius);
  const double other_angle = std::asin(half / other);
  const double apart = radius * std::cos(angle) + other * std::cos(other_angle);
  std::vector<Vector2d> line;
  add_arc({0, 0}, radius, angle, 2.0 * std::numbers::pi - angle, line);
  add_arc({apart, 0}, other, other_angle - std::numbers::pi, std::numbers::pi - other_angle, line);
  return contour_through(line);
}

/// A disc with a straight fin along the first axis.
Contour disc_with_fin(double radius, double length, double thickness) {
  const double half = 0.5 * thickness;
  const double angle = std::asin(half / radius);
  std::vector<Vector2d> line;
  add_arc({0, 0}, radius, angle, 2.0 * std::numbers::pi - angle, line);
  for (double x = radius; x < radius + length; x += 0.25) line.emplace_back(x, -half);
  for (double x = radius + length; x > radius; x -= 0.25) line.emplace_back(x, half);
  return contour_through(line);
}

/// How far two stations of the two hundred may lie beside the narrowest place, either of them.
double told_to(const Contour& contour) {
  return perimeter(contour.points) / 200.0;
}

TEST(SectionNeck, IsWhereTwoDiscsCross) {
  for (const double neck : {2.0, 8.0, 14.0}) {
    SCOPED_TRACE(neck);
    const Contour contour = round_two_discs(35.0, 25.0, neck);
    const auto found = SectionNeck::of(contour);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->width, neck, 2.0 * told_to(contour));
    const double crossing = std::sqrt(35.0 * 35.0 - 0.25 * neck * neck);
    EXPECT_NEAR(found->from.x(), crossing, 2.0 * told_to(contour));
    EXPECT_NEAR(found->to.x(), crossing, 2.0 * told_to(contour));
  }
}

TEST(SectionNeck, IsTheSameFromWhereverTheContourBegins) {
  Contour contour = round_two_discs(30.0, 30.0, 5.0);
  for (const std::ptrdiff_t begin : {0, 100, 399, 401}) {
    Contour turned = contour;
    std::rotate(turned.points.begin(), turned.points.begin() + begin, turned.points.end());
    std::rotate(turned.outward.begin(), turned.outward.begin() + begin, turned.outward.end());
    const auto found = SectionNeck::of(turned);
    ASSERT_TRUE(found) << begin;
    EXPECT_NEAR(found->width, 5.0, 2.0 * told_to(contour)) << begin;
  }
}

TEST(SectionNeck, IsNoneOfOtherSections) {
  EXPECT_FALSE(SectionNeck::of(round_two_discs(35.0, 25.0, 30.0))) << "hardly pinched";
  EXPECT_FALSE(SectionNeck::of(round_two_discs(35.0, 7.0, 2.0))) << "a wart";
  EXPECT_FALSE(SectionNeck::of(disc_with_fin(35.0, 80.0, 4.0))) << "a fin";
  EXPECT_FALSE(SectionNeck::of(disc_with_fin(35.0, 0.0, 4.0))) << "a disc";
}

}  // namespace
}  // namespace instep
