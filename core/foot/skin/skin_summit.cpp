#include "core/foot/skin/skin_summit.h"

#include <algorithm>

namespace instep {

std::optional<SummitAcross> summit_across(const SkinPatch& points, double from, double to) {
  const auto skin = QuadraticSkin::through(points);
  if (!skin || !(from <= to)) return std::nullopt;
  const auto& c = skin->coefficients();
  SummitAcross best{from, skin->at(0.0, from)};
  const double vertex = c(5) < 0.0 ? std::clamp(-c(2) / (2.0 * c(5)), from, to) : from;
  for (const double y : {vertex, to}) {
    if (skin->at(0.0, y) > best.reach) best = {y, skin->at(0.0, y)};
  }
  return best;
}

}  // namespace instep
