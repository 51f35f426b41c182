#include "core/foot/second_toe.h"

#include <cmath>

#include "core/foot/border_profile.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kBorderSmoothingMm = 9.0;
constexpr double kToeSmoothingMm = 5.0;
constexpr double kToeSummitMm = 2.0;
constexpr std::size_t kFewestToes = 3;
constexpr double kFurthestShareOff = 0.12;

struct BallBorders {
  double medial = 0.0;
  double breadth = 0.0;
};

std::optional<BallBorders> ball_borders(const std::vector<Vector2d>& outline, double length) {
  const BorderProfile medial(outline, Vector2d::UnitX(), Vector2d::UnitY(), kBorderSmoothingMm);
  const BorderProfile lateral(outline, Vector2d::UnitX(), -Vector2d::UnitY(), kBorderSmoothingMm);
  const auto inside = medial.furthest(0.55 * length, 0.85 * length);
  const auto outside = lateral.furthest(0.5 * length, 0.8 * length);
  if (!inside || !outside) return std::nullopt;
  return BallBorders{inside->reach, inside->reach + outside->reach};
}

}  // namespace

std::optional<SecondToe> find_second_toe(const std::vector<Vector2d>& outline, double length_mm) {
  const auto ball = ball_borders(outline, length_mm);
  if (!ball) return std::nullopt;
  std::vector<Vector2d> front;
  for (const auto& point : outline) {
    if (point.x() > 0.75 * length_mm) front.push_back(point);
  }
  const BorderProfile toes(front, Vector2d::UnitY(), Vector2d::UnitX(), kToeSmoothingMm);
  const double expected = ball->medial - kSecondToeShare * ball->breadth;
  const auto summits = toes.summits(ball->medial - ball->breadth, ball->medial, kToeSummitMm);

  const BorderProfile::Peak* nearest = nullptr;
  for (const auto& summit : summits) {
    if (nearest == nullptr ||
        std::abs(summit.place - expected) < std::abs(nearest->place - expected)) {
      nearest = &summit;
    }
  }
  if (summits.size() >= kFewestToes &&
      std::abs(nearest->place - expected) < kFurthestShareOff * ball->breadth) {
    return SecondToe{{nearest->reach, nearest->place}, true};
  }
  const auto reach = toes.reach(expected);
  if (!reach) return std::nullopt;
  return SecondToe{{*reach, expected}, false};
}

}  // namespace instep
