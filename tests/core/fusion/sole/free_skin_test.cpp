#include "core/fusion/sole/free_skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kTurn = std::numbers::pi / 3;

TEST(FreeSkin, IsAnArcWhereItsBendDoesNotFall) {
  const double radius = 10.0;
  const auto skin = free_skin(kTurn, 0.0, radius * (1.0 - std::cos(kTurn)));
  const Vector2d centre(radius * std::sin(kTurn), radius);
  for (const auto& corner : skin) EXPECT_NEAR((corner - centre).norm(), radius, 1e-3);
}

TEST(FreeSkin, ComesDownFromItsHeightAndEndsLevel) {
  for (const double falloff : {0.0, 1.0, 3.0}) {
    const auto skin = free_skin(kTurn, falloff, 6.0);
    EXPECT_EQ(skin.front().x(), 0.0);
    EXPECT_NEAR(skin.front().y(), 6.0, 1e-9);
    EXPECT_NEAR(skin.back().y(), 0.0, 1e-9);
    const Vector2d first = skin[1] - skin[0];
    EXPECT_NEAR(std::atan2(-first.y(), first.x()), kTurn, 0.1);
    const Vector2d last = skin[skin.size() - 1] - skin[skin.size() - 2];
    EXPECT_NEAR(last.y(), 0.0, 0.02 * last.x());
  }
}

TEST(FreeSkin, HasTheFalloffThatGivesTheBendItBeginsWith) {
  for (const double falloff : {0.5, 1.0, 2.0, 4.0}) {
    const double height = 7.0;
    const auto skin = free_skin(kTurn, falloff, height);
    const auto angle = [&](std::size_t piece) {
      const Vector2d way = skin[piece + 1] - skin[piece];
      return std::atan2(-way.y(), way.x());
    };
    // Turn over way, at the ends of the first two pieces, carried on to the skin's own end.
    const double first = angle(0) - angle(1);
    const double second = angle(1) - angle(2);
    const double bend = (2.0 * first - second) / (skin[1] - skin[0]).norm();
    EXPECT_NEAR(falloff_of_bend(kTurn, height * bend), falloff, 0.3) << falloff;
  }
}

TEST(FreeSkin, BendsMoreBelowWhereLittleBendWasSeen) {
  EXPECT_EQ(falloff_of_bend(kTurn, 0.0), 0.0);
  EXPECT_EQ(falloff_of_bend(kTurn, 0.3), 0.0);
}

}  // namespace
}  // namespace instep
