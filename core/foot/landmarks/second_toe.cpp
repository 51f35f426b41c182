#include "core/foot/landmarks/second_toe.h"

#include "core/foot/landmarks/toe_pattern.h"
#include "core/foot/skin/border_profile.h"
#include "core/foot/skin/border_smoothing.h"
#include "core/geometry/extent.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kToeSmoothingMm = 3.5;
constexpr double kToeStripMm = 1.0;
constexpr double kToeBendMm = 2.5;  ///< seen from above no toe is bent tighter
constexpr double kCleftMm = 1.0;    ///< depth from which a cleft parts two toes
constexpr double kToeRadiusShare =
    0.027;  ///< of a toe's tip seen from above, over the foot's length

/// Nearer to the medial border, a little behind its tip, no second toe's is, as a share of the
/// foot's length: beside it lies the big one, by far the broadest. Of a scanned foot the second was
/// 45 mm from it and the big one 22 to 26, of 98 % of 60 drawn feet the second 27 and more.
constexpr double kBesideBigToeShare = 0.105;
constexpr double kBehindTipShare = 15.0 / 260.0;

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

/// The direction that looks square at the line of the toes' tips: least squares over the border
/// from the little toe to the second one.
Vector2d square_to_toes(const BorderProfile& front, double from, double to) {
  constexpr int kSteps = 30;
  double count = 0.0, sum_y = 0.0, sum_x = 0.0, sum_yy = 0.0, sum_xy = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double y = from + (to - from) * i / kSteps;
    const auto x = front.reach(y);
    if (!x) continue;
    count += 1.0;
    sum_y += y;
    sum_x += *x;
    sum_yy += y * y;
    sum_xy += *x * y;
  }
  const double spread = count * sum_yy - sum_y * sum_y;
  if (!(spread > 0.0)) return Vector2d::UnitX();
  const double slope = (count * sum_xy - sum_x * sum_y) / spread;
  return Vector2d(1.0, -slope).normalized();
}

/// The toes that show, each by the point of its border that stands out most.
std::vector<Vector2d> visible_toes(const std::vector<Vector2d>& front, const Vector2d& square,
                                   const BallBorders& ball) {
  const Vector2d along(-square.y(), square.x());
  const BorderProfile toes(front, along, square, kToeSmoothingMm, kToeStripMm, kToeBendMm);
  const Extent shown = extent_along(front, along);
  std::vector<Vector2d> tips;
  if (!(shown.length() < 2.0 * ball.breadth)) return tips;
  for (const auto& summit : toes.summits(shown.from, shown.to, kCleftMm)) {
    tips.push_back(summit.place * along + summit.reach * square);
  }
  return tips;
}

/// Which tips have room for the big toe between them and the toes' medial border. A foot whose ball
/// bulges, as with a bunion, has all toes further from the border of that, by which they are named,
/// and its first where second toes are.
std::vector<bool> beside_a_big_toe(const std::vector<Vector2d>& tips,
                                   const std::vector<Vector2d>& front, double length) {
  const BorderProfile medial(front, Vector2d::UnitX(), Vector2d::UnitY(), kToeSmoothingMm);
  std::vector<bool> beside;
  for (const auto& tip : tips) {
    const auto border = medial.reach(tip.x() - kBehindTipShare * length);
    beside.push_back(!border || *border - tip.y() > kBesideBigToeShare * length);
  }
  return beside;
}

/// The foremost point of the toe that stands out most at `tip` when seen in the direction `square`,
/// by its roundness: a longer neighbour often hides one of its flanks from the front.
Vector2d foremost_of_toe(const Vector2d& tip, const Vector2d& square, double toe_radius) {
  return tip + toe_radius * (Vector2d::UnitX() - square);
}

}  // namespace

std::optional<SecondToe> find_second_toe(const std::vector<Vector2d>& outline, double length_mm) {
  const auto ball = ball_borders(outline, length_mm);
  if (!ball) return std::nullopt;
  std::vector<Vector2d> front;
  for (const auto& point : outline) {
    if (point.x() > 0.75 * length_mm) front.push_back(point);
  }
  if (front.empty()) return std::nullopt;
  const BorderProfile forwards(front, Vector2d::UnitY(), Vector2d::UnitX(), kToeSmoothingMm,
                               kToeStripMm, kToeBendMm);
  const double expected = ball->medial - kSecondToeShare * ball->breadth;

  const Vector2d square = square_to_toes(forwards, ball->medial - 0.9 * ball->breadth,
                                         ball->medial - 0.3 * ball->breadth);
  const auto toes = visible_toes(front, square, *ball);
  std::vector<double> shares;
  for (const auto& toe : toes) shares.push_back((ball->medial - toe.y()) / ball->breadth);
  if (const auto second = second_of_toes(shares, beside_a_big_toe(toes, front, length_mm))) {
    return SecondToe{foremost_of_toe(toes[*second], square, kToeRadiusShare * length_mm), true};
  }
  const auto reach = forwards.reach(expected);
  if (!reach) return std::nullopt;
  return SecondToe{{*reach, expected}, false};
}

}  // namespace instep
