#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/foot/foot_scan.h"
#include "core/foot/standing/standing_plane.h"
#include "core/result.h"

namespace instep {

/// What is known beforehand about a cloud of one foot.
struct AlignmentOptions {
  /// Forced side; without it the shape tells.
  std::optional<Side> side;
  /// That side is told by where the foot stands beside another, and feet may be crossed.
  bool is_side_by_place = false;
  /// The floor, where the station knows it: the pose is then not searched at all.
  std::optional<StandingPlane> standing_plane;
  /// Nobody saw that floor nor gave its height: heights over it are as doubtful as over one that is
  /// told by the sole.
  bool is_plane_guessed = false;
  /// Which way is up, where only that is known: the floor is then under the lowest points.
  std::optional<Eigen::Vector3d> up;
  /// The cloud was told from other things: large parts of it that lie apart are of one foot, of
  /// which no camera saw what joins them.
  bool is_one_foot = false;
  /// The definitions that the foot is measured by, its axis among them.
  MeasuringRules rules;
};

/// Puts the cloud of one foot into its own frame (see FootScan): standing plane, heel-toe axis,
/// side. Exact duplicates of points are dropped.
///
/// The axis is, unless the rules say otherwise, `pt_toe2` of the Japanese standard: from the
/// pternion to the tip of the second toe, in floor projection. An axis whose marks the points do
/// not show gives way to it, and it to that of the outline, with a warning. The landmarks
/// `pternion`, `acropodion` and, where the front has a border, `toe2_tip` are set; the others are
/// find_landmarks()'s business.
///
/// A floor round the foot (seen_floor()) is the one it stands on; it is left out with what lies
/// under the foot, and a warning says so. Strays, what stands apart and what stands beside the foot
/// are left out; a warning tells of large parts of one foot, and of what stands near it or touches
/// it. Normals that contradict the shape are dropped, with a warning. Of a noisy cloud the shape is
/// read off quieted points (FootScan::shape()). A sole that was not seen is closed on the floor
/// (close_open_sole()), as far below as its walls tell (floor_below()), with a warning; a foot
/// whose walls end too high to tell, and a last whose bottom was not seen, are refused with
/// kInsufficientData. A leg above the foot, an open sole and a cut at any height above the instep
/// are fine; most of a leg is left out, with a warning (foot_under_leg()). Fails with
/// kInsufficientData under 200 points, where over 3 % of them lie beyond both ends that were found,
/// and for a scan whose sole was closed if half of its heel or toes was not seen (unseen_half());
/// and with kInvalidInput, saying why, for what is no whole foot or is touched by something half as
/// large. A mirrored cloud gives the mirrored result. O(n log n).
Result<FootScan> align_foot(const PointCloud& cloud, const AlignmentOptions& options = {});

/// The foot by another cloud in its frame: side, floor and rules, and the three landmarks of
/// align_foot(); from there on as if that were its input. No other landmarks, no warnings.
FootScan aligned_as(const FootScan& foot, PointCloud cloud);

/// Finds floor, axis and ends again on a foot that stands in its own frame already, as after points
/// were taken away: moves its cloud into the new frame, adds the move to `foot_from_input`, and
/// sets the three landmarks, all others gone. The side stays. False, with the foot as it was, where
/// the points do not show the axis of the foot's rules any more.
///
/// `deeper_mm`: put the floor so much below where the points tell it.
[[nodiscard]] bool realign(FootScan& foot, double deeper_mm = 0.0);

}  // namespace instep
