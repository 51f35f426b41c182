#include "core/foot/landmarks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/foot/ball_points.h"
#include "core/foot/foot_outline.h"
#include "core/foot/midfoot_points.h"

namespace instep {
namespace {

constexpr double kPoorConfidence = 0.35;

using NamedLandmark = std::pair<const char*, std::optional<Landmark>>;

/// Turns a landmark of the right-foot form back into the foot's own frame.
Landmark in_own_frame(Landmark landmark, double medial_sign) {
  landmark.position_mm.y() *= medial_sign;
  return landmark;
}

}  // namespace

Result<FootScan> find_landmarks(FootScan foot) {
  if (!foot.landmarks.contains("pternion") || !foot.landmarks.contains("acropodion")) {
    return fail(ErrorCode::kInvalidInput, "the foot has not been aligned", "align it first");
  }
  const FootOutline outline(foot);
  const auto tibiale = find_metatarsale_tibiale(outline);
  const auto fibulare = tibiale ? find_metatarsale_fibulare(outline, *tibiale) : std::nullopt;
  const auto instep = find_instep_point(outline);
  const auto lateral = instep ? find_lateral_midfoot(outline, *instep) : std::nullopt;
  const auto arch = lateral ? find_medial_arch(outline, *instep, *lateral) : std::nullopt;

  for (const auto& [name, landmark] :
       {NamedLandmark{"metatarsale_tibiale", tibiale},
        NamedLandmark{"metatarsale_fibulare", fibulare}, NamedLandmark{"instep_point", instep},
        NamedLandmark{"lateral_midfoot", lateral}, NamedLandmark{"medial_arch", arch}}) {
    if (!landmark) {
      foot.warnings.push_back(std::string(name) + " not found: the cloud has no points there");
      continue;
    }
    if (landmark->confidence < kPoorConfidence) {
      foot.warnings.push_back(std::string(name) + " is placed by proportion: " + landmark->rule);
    }
    foot.landmarks[name] = in_own_frame(*landmark, foot.medial_sign());
  }
  return foot;
}

}  // namespace instep
