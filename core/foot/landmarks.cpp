#include "core/foot/landmarks.h"

#include <atomic>
#include <optional>
#include <string>
#include <utility>

#include "core/foot/landmarks/ankle_points.h"
#include "core/foot/landmarks/ball_points.h"
#include "core/foot/landmarks/heel_points.h"
#include "core/foot/landmarks/midfoot_points.h"
#include "core/foot/landmarks/other_side.h"
#include "core/foot/landmarks/redrawn_landmarks.h"
#include "core/foot/landmarks/toe_points.h"
#include "core/foot/skin/foot_outline.h"
#include "core/foot/standing/shoe_last.h"
#include "core/while_wanted.h"

namespace instep {
namespace {

/// Collects landmarks of the right-foot form into a foot, in its own frame.
class Marking {
 public:
  Marking(const FootOutline& outline, FootScan& foot) : outline_(outline), foot_(foot) {}

  std::optional<Landmark> add(const char* name, std::optional<Landmark> landmark) {
    if (!landmark) {
      foot_.warnings.push_back(std::string(name) +
                               " not found: the cloud has no points there, or a hole");
      return landmark;
    }
    if (landmark->is_placed_by_proportion()) {
      foot_.warnings.push_back(std::string(name) + " is placed by proportion: " + landmark->rule);
    }
    foot_.landmarks[name] = outline_.in_foot_frame(*landmark);
    return landmark;
  }

 private:
  const FootOutline& outline_;
  FootScan& foot_;
};

void mark_toes(const FootOutline& outline, const Landmark& tibiale, const Landmark& fibulare,
               Marking& marking) {
  marking.add("toe1_contact", find_toe1_contact(outline, tibiale));
  marking.add("toe5_contact", find_toe5_contact(outline, fibulare));
  const auto tip = marking.add("toe1_tip", find_toe1_tip(outline, tibiale, fibulare));
  if (tip) marking.add("toe1_top", find_toe1_top(outline, tibiale, fibulare, *tip));
}

void mark_forefoot(const FootOutline& outline, bool has_toes, Marking& marking) {
  // Where a border has no point of the ball, as in a hole, its furthest one is the hole's edge.
  const auto tibiale = marking.add("metatarsale_tibiale", find_metatarsale_tibiale(outline));
  if (!tibiale) return;
  marking.add("ball_medial", find_ball_medial(outline, *tibiale));
  const auto fibulare =
      marking.add("metatarsale_fibulare", find_metatarsale_fibulare(outline, *tibiale));
  if (!fibulare) return;
  marking.add("ball_lateral", find_ball_lateral(outline, *fibulare));
  marking.add("ball_top", find_ball_top(outline, *tibiale, *fibulare));
  if (has_toes) mark_toes(outline, *tibiale, *fibulare, marking);
}

void mark_hindfoot(const FootOutline& outline, bool has_leg, HeelBreadthRule rule,
                   Marking& marking) {
  // Where there is no leg, as on a last, the heel stands so high that the outline misses its
  // breadth.
  if (has_leg) {
    // Angles are counted from the heel's points, whatever its breadth is taken by.
    marking.add("heel_medial", find_heel_medial(outline, HeelBreadthRule::kSixth));
    marking.add("heel_lateral", find_heel_lateral(outline, HeelBreadthRule::kSixth));
    marking.add("heel_breadth_medial", find_heel_medial(outline, rule));
    marking.add("heel_breadth_lateral", find_heel_lateral(outline, rule));
    marking.add("medial_malleolus", find_medial_malleolus(outline));
  }
  const auto instep = marking.add("instep_point", find_instep_point(outline));
  if (!instep) return;
  const auto heel = marking.add(
      "heel_point",
      find_heel_point(outline, *instep, has_leg ? HeelStance::kOnFloor : HeelStance::kRaised));
  if (heel && has_leg) marking.add("junction", find_junction(outline, *heel));
  const auto lateral = marking.add("lateral_midfoot", find_lateral_midfoot(outline, *instep));
  if (lateral) marking.add("medial_arch", find_medial_arch(outline, *instep, *lateral));
}

}  // namespace

void mark(FootScan& foot) {
  const FootOutline outline(foot);
  Marking marking(outline, foot);
  const bool is_last = is_shoe_last(foot);
  if (is_last) {
    foot.warnings.emplace_back(
        "no toes, no leg and a raised heel: taken for a shoe last, which has no measures of toes, "
        "arch, heel breadth and ankle");
  }
  mark_forefoot(outline, !is_last, marking);
  mark_hindfoot(outline, !is_last, foot.rules.heel_breadth, marking);
  // Where points had to be put under a foot, nobody saw its arch.
  if (!is_last && !foot.cloud.stands_on_platform()) {
    marking.add("arch_point", find_arch_point(outline));
  }
}

Result<FootScan> find_landmarks(FootScan foot) {
  return find_landmarks_by(one_after_the_other, std::move(foot));
}

Result<FootScan> find_landmarks_by(const Workers& workers, FootScan foot, const GoOn& go_on) {
  if (!foot.landmarks.contains("pternion") || !foot.landmarks.contains("acropodion")) {
    return fail(ErrorCode::kInvalidInput, "the foot has not been aligned", "align it first");
  }
  mark(foot);
  std::atomic<bool> wanted = true;
  foot.redraws = redraw_landmarks(foot, while_wanted(workers, go_on, wanted));
  if (!wanted) return cancelled();
  foot.redraws.of_other_side = landmarks_of_other_side(foot);
  if (foot.redraws.of_other_side) {
    foot.warnings.push_back(
        std::string("the shape hardly tells left from right, so that all intervals reach to what "
                    "the other foot would have: check the side, or ") +
        kSayWhichFoot);
  }
  set_radii(foot);
  return foot;
}

}  // namespace instep
