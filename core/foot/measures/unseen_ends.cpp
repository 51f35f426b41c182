#include "core/foot/measures/unseen_ends.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "core/foot/alignment.h"
#include "core/foot/axis/outline_axis.h"
#include "core/foot/full_size.h"
#include "core/foot/landmarks.h"
#include "core/foot/landmarks/toe_points.h"
#include "core/foot/skin/end_facing.h"
#include "core/foot/skin/robust_extreme.h"
#include "core/foot/skin/skin_round.h"
#include "core/foot/standing/shoe_last.h"

namespace instep {
namespace {

// How squarely the skin faces at the toes (end_facing()): of 32 scans of the simulated station 0.78
// and more, of 200 drawn feet two have less than this, one by a hole there; of feet of 4,000 points
// one in ten, of 1,500 three. With 4 mm cut off all of 10 have less, with 8 mm nine.
constexpr double kLeastFacingOfToes = 0.7;
/// The same of the first toe for itself: of those feet none has less than 0.756, of 150 clouds of
/// 2,500 to 25,000 points of three real feet some eight, all of the one whose toes touch.
constexpr double kLeastFacingOfFirstToe = 0.75;
/// So far behind the foremost toe the first one may end, at full size.
constexpr double kFirstToeBehindMm = 15.0;
/// What then may be missing, set by eye: of the front of a foot that eight views of a real camera
/// saw the sides and the top of, some 5 mm. How the skin faces tells nothing of how much it is.
constexpr double kUnseenToesMm = 10.0;
constexpr double kToesShare = 0.7;  ///< of the length, from which on its front is looked at
/// What is missing of a heel at most, at full size, against what its skin lacks of facing
/// backwards: of 16 drawn feet with 4 to 24 mm cut off half have less than 29 mm, and 95 % less
/// than 40. Where the borders of what is left run straight on, nothing tells how much it is.
constexpr double kUnseenHeelMm = 45.0;
constexpr double kMostUnseenHeelMm = 25.0;
/// What may be missing of one that has a hole at its end, at full size: set by eye, as of toes.
constexpr double kHoleInHeelMm = 10.0;
/// How far the axis is off then, in radians: of 20 feet with 12 mm cut off 0.2 degrees on average,
/// 0.36 at most.
constexpr double kUnseenHeelTurn = 0.01;

/// An end as it was seen, at full size.
struct SeenEnd {
  double facing = 0.0;     ///< end_facing(); 0 of one without points
  double first_toe = 1.0;  ///< the same at the end of the first toe; 1 where that is not known
  bool is_whole = false;   ///< no hole in it
};

std::vector<Eigen::Vector3d> at_full_size(
    const FootScan& foot, const std::function<bool(const Eigen::Vector3d&)>& is_of) {
  const double factor = full_size_factor(foot.length_mm());
  std::vector<Eigen::Vector3d> part;
  for (const auto& point : foot.shape().positions) {
    if (is_of(point)) part.emplace_back(factor * point);
  }
  return part;
}

/// How squarely the first toe faces forwards at its end; 1 where nobody knows where it is. Where
/// its front was cut off, the foremost skin may be the second one's, which was seen whole.
double first_toe_facing(const FootScan& foot, const std::vector<Eigen::Vector3d>& toes) {
  const auto tibiale = foot.landmarks.find("metatarsale_tibiale");
  const auto fibulare = foot.landmarks.find("metatarsale_fibulare");
  if (tibiale == foot.landmarks.end() || fibulare == foot.landmarks.end()) return 1.0;
  const double factor = full_size_factor(foot.length_mm());
  const double medial = tibiale->second.position_mm.y();
  const double lateral = fibulare->second.position_mm.y();
  std::vector<Eigen::Vector3d> toe;
  for (const auto& point : toes) {
    if ((point.y() / factor - medial) / (lateral - medial) < kFirstToeShare) toe.push_back(point);
  }
  if (toe.empty()) return 1.0;
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d end = robust_extreme(toe, forward);
  // Further back is the little toe of a foot of the other side, or what was left of a first one.
  if (end.x() < kFullSizeMm - kFirstToeBehindMm) return 1.0;
  return end_facing(toe, end, forward).value_or(1.0);
}

SeenEnd seen_toes(const FootScan& foot) {
  const double length = foot.length_mm();
  const auto toes =
      at_full_size(foot, [&](const auto& point) { return point.x() > kToesShare * length; });
  const Eigen::Vector3d tip =
      full_size_factor(length) * foot.landmarks.at("acropodion").position_mm;
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
  // Where the first toe is a hole, the tip of the next one is as round.
  const bool is_first_missing =
      foot.landmarks.contains("metatarsale_fibulare") && !foot.landmarks.contains("toe1_tip");
  return {end_facing(toes, tip, forward).value_or(0.0), first_toe_facing(foot, toes),
          !is_first_missing && is_skin_all_round(toes, tip, forward)};
}

/// At the rearmost place of its skin; the pternion may lie in the middle of what was not seen.
SeenEnd seen_heel(const FootScan& foot) {
  const double length = foot.length_mm();
  const auto heel =
      at_full_size(foot, [&](const auto& point) { return point.x() < kHeelShare * length; });
  std::vector<Eigen::Vector3d> low;
  for (const auto& point : heel) {
    if (point.z() < kOutlineHeightShare * kFullSizeMm) low.push_back(point);
  }
  if (low.empty()) return {};
  const Eigen::Vector3d back = -Eigen::Vector3d::UnitX();
  const Eigen::Vector3d end = robust_extreme(low, back);
  return {end_facing(low, end, back).value_or(0.0), 1.0, is_skin_all_round(heel, end, back)};
}

/// What may be missing of it; 0 of one that was seen whole.
double missing_of_toes_mm(const SeenEnd& toes) {
  const bool is_closed = toes.is_whole && toes.facing >= kLeastFacingOfToes &&
                         toes.first_toe >= kLeastFacingOfFirstToe;
  return is_closed ? 0.0 : kUnseenToesMm;
}

/// The same, at full size.
double missing_of_heel_mm(const SeenEnd& heel) {
  const double by_facing =
      heel.facing < kLeastFacingOfHeel ? kUnseenHeelMm * (1.0 - heel.facing) : 0.0;
  return std::max(by_facing, heel.is_whole ? 0.0 : kHoleInHeelMm);
}

/// How a foot may go on beyond what was seen of it.
struct Unseen {
  double heel_mm = 0.0;
  double toes_mm = 0.0;
  double turn = 0.0;  ///< of its axis, round the pternion
};

/// The foot with its heel so much further back, as its own frame then has it, and with its toes so
/// much further forward. What was told by aligning it stays where it is.
RedrawnLandmarks lengthened(const FootScan& foot, const Unseen& unseen) {
  const RigidTransform longer_from_foot =
      RigidTransform(Eigen::AngleAxisd(unseen.turn, Eigen::Vector3d::UnitZ())) *
      Eigen::Translation3d(unseen.heel_mm, 0.0, 0.0);
  FootScan longer = aligned_as(foot, transformed(longer_from_foot, foot.shape()));
  for (auto& [name, landmark] : longer.landmarks) {
    if (name != "pternion") landmark.position_mm = longer_from_foot * landmark.position_mm;
  }
  longer.landmarks.at("acropodion").position_mm.x() += unseen.toes_mm;
  mark(longer);
  return {std::move(longer.landmarks), longer_from_foot.inverse()};
}

}  // namespace

std::optional<UnseenEnds> unseen_ends(const FootScan& foot) {
  if (is_shoe_last(foot)) return std::nullopt;
  UnseenEnds ends;
  const double toes_mm = missing_of_toes_mm(seen_toes(foot));
  if (toes_mm > 0.0) {
    ends.warning = "the foremost part of the toes";
    ends.if_longer.push_back(lengthened(foot, {.toes_mm = toes_mm}));
  }
  const double heel_mm = missing_of_heel_mm(seen_heel(foot)) / full_size_factor(foot.length_mm());
  if (heel_mm > 0.0) {
    ends.warning +=
        (ends.warning.empty() ? "" : " and ") + std::string("the rearmost part of the heel");
    ends.if_longer.push_back(lengthened(foot, {.heel_mm = std::min(heel_mm, kMostUnseenHeelMm)}));
    ends.if_longer.push_back(lengthened(foot, {.turn = foot.medial_sign() * kUnseenHeelTurn}));
  }
  if (ends.if_longer.empty()) return std::nullopt;
  ends.warning +=
      " was not seen, or by too few points: the foot may be longer, and what is placed by its "
      "length lie elsewhere; scan again, with all of it in view";
  return ends;
}

}  // namespace instep
