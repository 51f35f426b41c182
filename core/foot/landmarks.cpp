#include "core/foot/landmarks.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/foot/ankle_points.h"
#include "core/foot/ball_points.h"
#include "core/foot/foot_outline.h"
#include "core/foot/heel_points.h"
#include "core/foot/midfoot_points.h"
#include "core/foot/redrawn_landmarks.h"
#include "core/foot/toe_points.h"

namespace instep {
namespace {

constexpr double kPoorConfidence = 0.35;

/// Collects landmarks of the right-foot form into a foot, in its own frame.
class Marking {
 public:
  explicit Marking(FootScan& foot) : foot_(foot) {}

  std::optional<Landmark> add(const char* name, std::optional<Landmark> landmark) {
    if (!landmark) {
      foot_.warnings.push_back(std::string(name) + " not found: the cloud has no points there");
      return landmark;
    }
    if (landmark->confidence < kPoorConfidence) {
      foot_.warnings.push_back(std::string(name) + " is placed by proportion: " + landmark->rule);
    }
    Landmark own = *landmark;
    own.position_mm.y() *= foot_.medial_sign();
    foot_.landmarks[name] = own;
    return landmark;
  }

 private:
  FootScan& foot_;
};

std::vector<Eigen::Vector3d> seen_points(const FootScan& foot, const FootOutline& outline) {
  std::vector<Eigen::Vector3d> seen;
  for (std::size_t i = 0; i < outline.points().size(); ++i) {
    if (foot.cloud.was_seen(i)) seen.push_back(outline.points()[i]);
  }
  return seen;
}

void mark_forefoot(const FootOutline& outline, Marking& marking) {
  marking.add("ball_medial", find_ball_medial(outline));
  marking.add("ball_lateral", find_ball_lateral(outline));
  const auto tibiale = marking.add("metatarsale_tibiale", find_metatarsale_tibiale(outline));
  if (!tibiale) return;
  marking.add("toe1_contact", find_toe1_contact(outline, *tibiale));
  const auto fibulare =
      marking.add("metatarsale_fibulare", find_metatarsale_fibulare(outline, *tibiale));
  if (!fibulare) return;
  marking.add("ball_top", find_ball_top(outline, *tibiale, *fibulare));
  marking.add("toe5_contact", find_toe5_contact(outline, *fibulare));
  const auto tip = marking.add("toe1_tip", find_toe1_tip(outline, *tibiale, *fibulare));
  if (tip) marking.add("toe1_top", find_toe1_top(outline, *tibiale, *fibulare, *tip));
}

void mark_hindfoot(const FootOutline& outline, Marking& marking) {
  marking.add("heel_medial", find_heel_medial(outline));
  marking.add("heel_lateral", find_heel_lateral(outline));
  marking.add("medial_malleolus", find_medial_malleolus(outline));
  const auto instep = marking.add("instep_point", find_instep_point(outline));
  if (!instep) return;
  const auto heel = marking.add("heel_point", find_heel_point(outline, *instep));
  if (heel) marking.add("junction", find_junction(outline, *heel));
  const auto lateral = marking.add("lateral_midfoot", find_lateral_midfoot(outline, *instep));
  if (lateral) marking.add("medial_arch", find_medial_arch(outline, *instep, *lateral));
}

}  // namespace

void mark(FootScan& foot) {
  const FootOutline outline(foot);
  Marking marking(foot);
  mark_forefoot(outline, marking);
  mark_hindfoot(outline, marking);
  marking.add("arch_point", find_arch_point(outline, seen_points(foot, outline)));
}

Result<FootScan> find_landmarks(FootScan foot) {
  if (!foot.landmarks.contains("pternion") || !foot.landmarks.contains("acropodion")) {
    return fail(ErrorCode::kInvalidInput, "the foot has not been aligned", "align it first");
  }
  mark(foot);
  foot.redrawn = redraw_landmarks(foot);
  set_radii(foot);
  return foot;
}

}  // namespace instep
