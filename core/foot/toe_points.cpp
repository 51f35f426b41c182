#include "core/foot/toe_points.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kFirstToeShare = 0.30;  ///< of the ball's breadth, from medial
constexpr double kBehindTipMm = 15.0;
constexpr double kToeSmoothingMm = 5.0;
constexpr double kBearingStep = 0.005;

double inner_limit(const Landmark& tibiale, const Landmark& fibulare) {
  const double inner = tibiale.position_mm.y();
  return inner + kFirstToeShare * (fibulare.position_mm.y() - inner);
}

std::vector<Vector3d> toes_of(const FootOutline& outline) {
  std::vector<Vector3d> toes;
  for (const auto& point : outline.points()) {
    if (point.x() > 0.75 * outline.length_mm() && point.z() < 0.2 * outline.length_mm()) {
      toes.push_back(point);
    }
  }
  return toes;
}

/// The place of the border whose bearing from `ball` is most outwards. `sign` +1 medial.
std::optional<Landmark> ruler_contact(const SkinBorder& border, const Vector3d& ball, double sign,
                                      double from, double to, double length, const char* rule) {
  std::optional<Vector3d> contact;
  double most = 0.0;
  for (double share = from; share <= to + 1e-9; share += kBearingStep) {
    const auto place = border.at(share * length);
    if (!place) continue;
    const Vector3d point = border.position(*place);
    if (point.x() <= ball.x() + 1.0) continue;
    const double bearing = sign * (point.y() - ball.y()) / (point.x() - ball.x());
    if (contact && bearing <= most) continue;
    contact = point;
    most = bearing;
  }
  if (!contact) return std::nullopt;
  return Landmark{*contact, 0.7, rule};
}

}  // namespace

std::optional<Landmark> find_toe1_tip(const FootOutline& outline, const Landmark& tibiale,
                                      const Landmark& fibulare) {
  const SkinBorder front(
      toes_of(outline),
      {Vector3d::UnitY(), Vector3d::UnitX(), Vector3d::UnitZ(), 0.0, kLandmarkOutlineHeightMm},
      kToeSmoothingMm);
  const auto tip = front.furthest(inner_limit(tibiale, fibulare), tibiale.position_mm.y());
  if (!tip) return std::nullopt;
  return Landmark{front.position(*tip), 0.7,
                  "foremost point in the medial 0.30 of the ball's breadth"};
}

std::optional<Landmark> find_toe1_top(const FootOutline& outline, const Landmark& tibiale,
                                      const Landmark& fibulare, const Landmark& tip) {
  const SkinBorder back(toes_of(outline),
                        {Vector3d::UnitX(), Vector3d::UnitZ(), Vector3d::UnitY(),
                         inner_limit(tibiale, fibulare), tibiale.position_mm.y()},
                        kToeSmoothingMm);
  const auto top = back.at(tip.position_mm.x() - kBehindTipMm);
  if (!top) return std::nullopt;
  return Landmark{back.position(*top), 0.7, "highest point 15 mm behind the first toe's tip"};
}

std::optional<Landmark> find_toe1_contact(const FootOutline& outline, const Landmark& tibiale) {
  return ruler_contact(outline.medial(), tibiale.position_mm, 1.0, 0.80, 0.95, outline.length_mm(),
                       "most medial bearing from metatarsale tibiale in 0.80-0.95 of the foot's "
                       "length");
}

std::optional<Landmark> find_toe5_contact(const FootOutline& outline, const Landmark& fibulare) {
  return ruler_contact(outline.lateral(), fibulare.position_mm, -1.0, 0.70, 0.85,
                       outline.length_mm(),
                       "most lateral bearing from metatarsale fibulare in 0.70-0.85 of the foot's "
                       "length");
}

}  // namespace instep
