#include "core/girth/contour/contour_zigzags.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace instep {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A circle of radius 1 with waves on it, by the angle from `first` in `count` corners.
Contour wavy_circle(const std::function<double(double)>& wave, double first = 0.0,
                    int count = 3000) {
  const auto at = [&](double angle) -> Eigen::Vector2d {
    return (1.0 + wave(std::remainder(angle, kTurn))) *
           Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  Contour contour;
  for (int i = 0; i < count; ++i) {
    const double angle = first + kTurn * i / count;
    const Eigen::Vector2d along = at(angle + 1e-6) - at(angle - 1e-6);
    contour.points.push_back(at(angle));
    contour.outward.push_back(Eigen::Vector2d(along.y(), -along.x()).normalized());
  }
  return contour;
}

/// Of one height or depth round the angle 0, `wide` across.
std::function<double(double)> bump(double height, double wide) {
  return [=](double angle) { return height * std::exp(-8.0 * std::pow(angle / wide, 2)); };
}

Zigzags zigzags_on(const Contour& contour, double way) {
  return zigzags_of(ContourCourse(contour), way);
}

TEST(ContourZigzags, AreNoneOfARoundContour) {
  EXPECT_EQ(zigzags_on(wavy_circle([](double) { return 0.0; }), 0.5).way, 0.0);
}

/// A fold that is far wider than the points are apart is told by them.
TEST(ContourZigzags, AreNoneOfWideFolds) {
  const auto folds = [](double angle) { return 0.2 * std::cos(5.0 * angle); };
  EXPECT_EQ(zigzags_on(wavy_circle(folds), 0.5).way, 0.0);
  EXPECT_GT(zigzags_on(wavy_circle(folds), 2.0).way, 0.0);
}

/// Both lengths are what the bump adds to the circle, to the little that its feet are off it.
TEST(ContourZigzags, AddWhatASpurAdds) {
  const Contour round = wavy_circle([](double) { return 0.0; });
  const Contour contour = wavy_circle(bump(0.2, 0.2));
  const auto spur = zigzags_on(contour, 0.6);
  EXPECT_GT(spur.way, 0.6);
  EXPECT_LT(spur.way, 1.2);
  EXPECT_NEAR(spur.contact, contour.length() - round.length(), 0.02);
  EXPECT_NEAR(spur.stretched, contour.tape_length() - round.tape_length(), 0.02);
}

/// A tape bridges a dent.
TEST(ContourZigzags, AddNothingToATapeThatBridgesThem) {
  const auto dent = zigzags_on(wavy_circle(bump(-0.2, 0.2)), 0.6);
  EXPECT_GT(dent.contact, 0.2);
  EXPECT_LT(dent.stretched, 0.2 * dent.contact);
}

TEST(ContourZigzags, AreTheSameWhereverTheContourBegins) {
  const auto spur = zigzags_on(wavy_circle(bump(0.2, 0.2)), 0.6);
  for (int i = 1; i < 60; ++i) {
    const auto same = zigzags_on(wavy_circle(bump(0.2, 0.2), kTurn * i / 60), 0.6);
    EXPECT_NEAR(same.way, spur.way, 0.01) << i;
    EXPECT_NEAR(same.contact, spur.contact, 0.01) << i;
    EXPECT_NEAR(same.stretched, spur.stretched, 0.01) << i;
  }
}

TEST(ContourZigzags, MayBeAllOfAContour) {
  const Contour contour =
      wavy_circle([](double angle) { return 0.05 * std::cos(40.0 * angle); }, 0.0, 20000);
  const auto all = zigzags_on(contour, 0.6);
  EXPECT_NEAR(all.way, ContourCourse(contour).length(), 1e-9);
  EXPECT_NEAR(all.contact, all.way, 1e-9);
}

}  // namespace
}  // namespace instep
