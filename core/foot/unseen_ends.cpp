#include "core/foot/unseen_ends.h"

#include <utility>

#include "core/foot/end_facing.h"
#include "core/foot/landmarks.h"
#include "core/foot/shoe_last.h"

namespace instep {
namespace {

// How squarely the skin faces at its ends (end_facing()), by 40 drawn feet and 46 scans of the
// simulated station: whole heels 0.95 and more, 25 mm cut off 0.6 and less; whole toes of the
// station 0.82 and more, drawn ones nine in ten 0.85, one with a hole there 0.5, and 12 mm cut off
// 0.6 and less of 34. Of 1,500 points one whole foot in seven seems to be cut off; of feet cut 8 mm
// short, five of six do at the toes and two of six at the heel.
constexpr double kLeastFacingOfToes = 0.6;
constexpr double kLeastFacingOfHeel = 0.8;
/// What then may be missing, set by eye: of the front of a foot that eight views of a real camera
/// saw the sides and the top of, some 5 mm.
constexpr double kUnseenEndMm = 10.0;

double facing_at(const char* end, const Eigen::Vector3d& direction, const FootScan& foot) {
  const Eigen::Vector3d& place = foot.landmarks.at(end).position_mm;
  return end_facing(foot.cloud.positions, place, direction).value_or(1.0);
}

/// The foot with its heel so much further back, as its own frame then has it, and with its toes so
/// much further forward. What was told by aligning it stays where it is.
RedrawnLandmarks lengthened(const FootScan& foot, double heel_mm, double toes_mm) {
  FootScan longer;
  longer.cloud = foot.cloud;
  longer.side = foot.side;
  longer.is_floor_known = foot.is_floor_known;
  longer.rules = foot.rules;
  for (auto& position : longer.cloud.positions) position.x() += heel_mm;
  for (const char* name : {"pternion", "acropodion", "toe2_tip"}) {
    const auto found = foot.landmarks.find(name);
    if (found != foot.landmarks.end()) longer.landmarks.insert(*found);
  }
  const auto toe = longer.landmarks.find("toe2_tip");
  if (toe != longer.landmarks.end()) toe->second.position_mm.x() += heel_mm;
  longer.landmarks.at("acropodion").position_mm.x() += heel_mm + toes_mm;
  mark(longer);
  RedrawnLandmarks redrawn{std::move(longer.landmarks), RigidTransform::Identity()};
  redrawn.foot_from_redrawn.translation().x() = -heel_mm;
  return redrawn;
}

}  // namespace

std::optional<UnseenEnds> unseen_ends(const FootScan& foot) {
  if (is_shoe_last(foot)) return std::nullopt;
  UnseenEnds ends;
  if (facing_at("acropodion", Eigen::Vector3d::UnitX(), foot) < kLeastFacingOfToes) {
    ends.warning = "the foremost part of the toes";
    ends.if_longer.push_back(lengthened(foot, 0.0, kUnseenEndMm));
  }
  if (facing_at("pternion", -Eigen::Vector3d::UnitX(), foot) < kLeastFacingOfHeel) {
    ends.warning +=
        (ends.warning.empty() ? "" : " and ") + std::string("the rearmost part of the heel");
    ends.if_longer.push_back(lengthened(foot, kUnseenEndMm, 0.0));
  }
  if (ends.if_longer.empty()) return std::nullopt;
  ends.warning +=
      " was not seen, or by too few points: the foot may be longer, and what is placed by its "
      "length lie elsewhere; scan again, with all of it in view";
  return ends;
}

}  // namespace instep
