#include "core/foot/landmarks/ankle_points.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/foot/skin/border_crest.h"
#include "core/foot/skin/border_smoothing.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kLowest = 0.22;
constexpr double kHighest = 0.38;
constexpr double kUsual = 0.30;
/// A millimetre less protrusion counts as much as this share of the length off the usual height.
constexpr double kSpread = 0.03;
/// The skin has to go on so far above the point for it to be told from the leg's cut end.
constexpr double kAboveMm = 5.0;
constexpr double kFrom = 0.10;
constexpr double kTo = 0.45;
constexpr CrestPatch kPatch{8.0, 14.0};

}  // namespace

std::optional<Landmark> find_medial_malleolus(const FootOutline& outline) {
  const double length = outline.length_mm();
  std::vector<Vector3d> leg;
  double top = 0.0;
  for (const auto& point : outline.points()) {
    const bool is_near = point.x() > 0.0 && point.x() < 0.5 * length && point.y() > 0.0 &&
                         point.z() > (kLowest - 0.06) * length &&
                         point.z() < (kHighest + 0.06) * length;
    if (!is_near) continue;
    leg.push_back(point);
    top = std::max(top, point.z());
  }
  const SkinBorder side(
      leg, {Vector3d::UnitZ(), Vector3d::UnitY(), Vector3d::UnitX(), kFrom * length, kTo * length},
      kBorderSmoothingMm);
  const auto peak = side.furthest(kLowest * length, kHighest * length, [&](double height) {
    return std::pow((height / length - kUsual) / kSpread, 2);
  });
  if (!peak) return std::nullopt;
  const auto crest =
      crest_near(leg, side.view(), *peak, kPatch, UsualPlace{kUsual * length, kSpread * length});
  const bool is_in_range =
      crest && crest->along >= kLowest * length && crest->along <= kHighest * length;
  const auto steadier = is_in_range ? side.at(crest->along) : std::nullopt;
  const SkinBorder::Place place = steadier.value_or(*peak);
  if (place.along > top - kAboveMm) return std::nullopt;
  if (!outline.was_seen(side.position(place))) return std::nullopt;
  return Landmark{side.position(place), 0.6,
                  "most medial point at 0.22-0.38 of the foot's length over the floor, weighed by "
                  "nearness to 0.30"};
}

}  // namespace instep
