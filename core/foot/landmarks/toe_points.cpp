#include "core/foot/landmarks/toe_points.h"

#include <algorithm>
#include <vector>

#include "core/foot/skin/border_crest.h"
#include "core/foot/skin/skin_round.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kBehindTipMm = 15.0;
constexpr double kToeSmoothingMm = 5.0;
constexpr double kBearingStepMm = 1.0;
constexpr CrestPatch kLittleToePatch{7.0, 8.0};
constexpr int kRulerRounds = 2;  ///< the crest turns the ruler a little
constexpr double kConfidence = 0.7;

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
std::optional<Vector3d> ruler_contact(const SkinBorder& border, const Vector3d& ball, double sign,
                                      double from, double to) {
  std::optional<Vector3d> contact;
  double most = 0.0;
  for (double along = from; along <= to; along += kBearingStepMm) {
    const auto place = border.at(along);
    if (!place) continue;
    const Vector3d point = border.position(*place);
    if (point.x() <= ball.x() + 1.0) continue;
    const double bearing = sign * (point.y() - ball.y()) / (point.x() - ball.x());
    if (contact && bearing <= most) continue;
    contact = point;
    most = bearing;
  }
  return contact;
}

/// Whether a place on a border (`sign` +1 medial) is skin that tells.
bool is_told_skin(const FootOutline& outline, const Vector3d& place, double sign) {
  return outline.is_told(place) &&
         is_skin_all_round(outline.points(), place, sign * Vector3d::UnitY());
}

/// Where the little toe near `contact` is furthest towards a ruler laid from `ball` to there.
std::optional<Vector3d> crest_at_ruler(const FootOutline& outline, const Vector3d& ball,
                                       const Vector3d& contact) {
  const Vector3d up = Vector3d::UnitZ();
  BorderView view;
  view.along = Vector3d(contact.x() - ball.x(), contact.y() - ball.y(), 0.0).normalized();
  view.outwards = view.along.cross(up);
  view.across = up;
  view.across_to_mm = kLandmarkOutlineHeightMm;
  const SkinBorder::Place start{view.along.dot(contact), view.outwards.dot(contact), contact.z()};
  const auto crest = crest_near(outline.points(), view, start, kLittleToePatch);
  if (!crest) return std::nullopt;
  return crest->along * view.along + crest->reach * view.outwards + crest->across * up;
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
  const Vector3d position = front.position(*tip);
  if (!is_skin_all_round(outline.points(), position, Vector3d::UnitX())) return std::nullopt;
  return Landmark{position, kConfidence, "foremost point in the medial 0.30 of the ball's breadth"};
}

std::optional<Landmark> find_toe1_top(const FootOutline& outline, const Landmark& tibiale,
                                      const Landmark& fibulare, const Landmark& tip) {
  const SkinBorder back(toes_of(outline),
                        {Vector3d::UnitX(), Vector3d::UnitZ(), Vector3d::UnitY(),
                         inner_limit(tibiale, fibulare), tibiale.position_mm.y()},
                        kToeSmoothingMm);
  const auto top = back.at(tip.position_mm.x() - kBehindTipMm);
  if (!top) return std::nullopt;
  const Vector3d position = back.position(*top);
  const bool is_skin = outline.was_seen(position) &&
                       is_skin_all_round(outline.points(), position, Vector3d::UnitZ());
  if (!is_skin) return std::nullopt;
  return Landmark{position, kConfidence,
                  "highest point 15/260 of the foot's length behind the first toe's tip"};
}

std::optional<Landmark> find_toe1_contact(const FootOutline& outline, const Landmark& tibiale) {
  const double length = outline.length_mm();
  const auto contact =
      ruler_contact(outline.medial(), tibiale.position_mm, 1.0, 0.80 * length, 0.95 * length);
  if (!contact || !is_told_skin(outline, *contact, 1.0)) return std::nullopt;
  return Landmark{*contact, kConfidence,
                  "most medial bearing from metatarsale tibiale in 0.80-0.95 of the foot's length"};
}

std::optional<Landmark> find_toe5_contact(const FootOutline& outline, const Landmark& fibulare) {
  const Vector3d& ball = fibulare.position_mm;
  const double from = 0.70 * outline.length_mm();
  const double to = 0.85 * outline.length_mm();
  auto contact = ruler_contact(outline.lateral(), ball, -1.0, from, to);
  if (!contact) return std::nullopt;
  // The border is smoothed over the gap to the next toe, and so lies too far in before it.
  for (int round = 0; round < kRulerRounds; ++round) {
    const auto crest = crest_at_ruler(outline, ball, *contact);
    if (!crest || crest->x() < std::max(from, ball.x() + 1.0) || crest->x() > to) break;
    contact = crest;
  }
  if (!is_told_skin(outline, *contact, -1.0)) return std::nullopt;
  return Landmark{*contact, kConfidence,
                  "most lateral bearing from metatarsale fibulare in 0.70-0.85 of the foot's "
                  "length"};
}

}  // namespace instep
