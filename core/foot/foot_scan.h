#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/foot/cloud/quieted.h"
#include "core/foot/cloud/scanner_lines.h"
#include "core/foot/measuring_rules.h"
#include "core/foot/side.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// A point of anatomy found on the cloud.
struct Landmark {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< foot frame
  double confidence = 0.0;                                ///< 0 to 1; by proportion under 0.35
  std::string rule;                                       ///< how it was found, in a few words
  /// Within this of the true place with 95 % probability, as far as the points and
  /// `deviations_off_mm` tell; with the way to that of the other foot where the side is not sure.
  std::optional<double> radius_mm = std::nullopt;
  /// Where it lies instead, as seen from there, if something that redraws share, and so do not
  /// show, is one standard deviation off; each for itself: of `heel_point` the edge of a standing
  /// foot's sole, of the points of the ball and the heel's sides a border that was not seen there.
  /// None of all others.
  std::vector<Eigen::Vector3d> deviations_off_mm = {};

  /// The points hardly tell where it is. Of `toe2_tip` FootScan::has_seen_toes() tells instead.
  bool is_placed_by_proportion() const { return confidence < 0.35; }
};

using Landmarks = std::map<std::string, Landmark>;

/// The landmarks as a part of the points would have given them: how they scatter tells how sure
/// they are (core/foot/landmarks/redrawn_landmarks.h).
struct RedrawnLandmarks {
  Landmarks landmarks;  ///< in the frame that the part gave
  RigidTransform foot_from_redrawn = RigidTransform::Identity();
};

/// How the points are parted for redraws: at random into `parts` of equal size, of which each is
/// taken alone or, where points are few, left out alone.
struct Parting {
  std::size_t parts = 0;
  bool is_part_left_out = false;
  bool is_by_line = false;  ///< whole lines of a scanner in turn, not points
};

/// All redraws: the cloud was parted, maybe several times, and the redraws of one parting, one for
/// each part, follow each other.
struct Redraws {
  Parting parting;
  std::vector<RedrawnLandmarks> landmarks;
  /// The same once more, with the local errors of the points drawn anew; none where the cloud knows
  /// of none.
  std::vector<RedrawnLandmarks> erring;
  /// Of all points, as those of the other foot; none where the side is sure.
  std::optional<RedrawnLandmarks> of_other_side;
};

/// How much deeper the floor was put than the lowest skin that was seen, of a sole that was not
/// (floor_below()); zero of one that was.
struct FloorBelow {
  double depth_mm = 0.0;
  double u95_mm = 0.0;  ///< half-width of its 95 % interval
};

/// One foot in its own frame, ready to be measured.
///
/// Foot frame: origin at the pternion projected on the floor, x from heel to toes, z up from the
/// floor, y completing a right-handed frame (so the medial side of a right foot has y > 0 and that
/// of a left foot y < 0). Left feet are not mirrored here; a rule that needs "medial" asks
/// medial_sign().
struct FootScan {
  PointCloud cloud;                     ///< foot frame
  std::optional<QuietedCloud> quieted;  ///< foot frame; nothing unless the cloud is noisy
  std::optional<ScannerLines> lines;    ///< of a scanner (scanner_lines()), as the input lies
  std::size_t cloud_number = 0;         ///< among those that align_feet() was given
  Side side = Side::kRight;
  double side_confidence = 0.0;  ///< 0.5 (a coin) to 1
  RigidTransform foot_from_input = RigidTransform::Identity();
  bool is_floor_known = false;  ///< given with the cloud, not found from it
  FloorBelow floor_below;       ///< its lowest skin, where no sole was seen
  MeasuringRules rules;         ///< by which it is aligned, marked and measured
  Landmarks landmarks;
  Redraws redraws;  ///< none before find_landmarks()
  std::vector<std::string> warnings;

  /// What landmarks are found on: the cloud, without its noise where that is large.
  const PointCloud& shape() const { return quieted ? quieted->cloud : cloud; }

  /// Whether left was told from right, by the shape, the other foot or whoever knew it.
  bool is_side_sure() const { return side_confidence >= kSureSide; }

  /// Whether the second toe was told from its neighbours, which aligning a foot finds out.
  bool has_seen_toes() const {
    const auto toe = landmarks.find("toe2_tip");
    return toe != landmarks.end() && toe->second.confidence > 0.5;
  }

  /// From the heel's end to that of the toes, along the axis; of an aligned foot.
  double length_mm() const { return landmarks.at("acropodion").position_mm.x(); }

  /// +1 where medial is +y (right foot), -1 where it is -y (left foot).
  double medial_sign() const { return side == Side::kRight ? 1.0 : -1.0; }
};

}  // namespace instep
