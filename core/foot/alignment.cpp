#include "core/foot/alignment.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/foot/axis/foot_axis.h"
#include "core/foot/axis/outline_axis.h"
#include "core/foot/axis/side_from_shape.h"
#include "core/foot/cloud/normals_of_shape.h"
#include "core/foot/cloud/scanner_lines.h"
#include "core/foot/sole/floor_below.h"
#include "core/foot/sole/open_sole.h"
#include "core/foot/standing/foot_alone.h"
#include "core/foot/standing/plane_under_foot.h"
#include "core/foot/standing/shoe_last.h"
#include "core/foot/standing/unseen_half.h"
#include "core/in_millimetres.h"
#include "core/in_percent.h"

namespace instep {
namespace {

Result<void> check_options(const AlignmentOptions& options) {
  const auto is_unit = [](const Eigen::Vector3d& up) { return std::abs(up.norm() - 1.0) < 1e-6; };
  if ((options.up && !is_unit(*options.up)) ||
      (options.standing_plane && !(is_unit(options.standing_plane->up) &&
                                   std::isfinite(options.standing_plane->height_mm)))) {
    return fail(ErrorCode::kInvalidInput, "the floor's direction is not a unit vector",
                "give the direction that points up, of length 1");
  }
  return {};
}

Result<StandingPlane> standing_plane(const PointCloud& cloud, const AlignmentOptions& options) {
  if (options.standing_plane) return *options.standing_plane;
  if (options.up) return plane_below(cloud.positions, *options.up);
  return plane_under_foot(cloud);
}

/// Of the points that are no leg's, those clearly before the toes that were found or behind the
/// heel.
double share_beyond_ends(const FootScan& foot) {
  constexpr double kLegInLengths = 0.35;  // above the floor
  constexpr double kClearlyInLengths = 0.1;
  const double length = foot.length_mm();
  double low = 0.0;
  double beyond = 0.0;
  for (const auto& point : foot.shape().positions) {
    if (point.z() > kLegInLengths * length) continue;
    low += 1.0;
    if (std::abs(point.x() / length - 0.5) > 0.5 + kClearlyInLengths) beyond += 1.0;
  }
  return beyond / std::max(low, 1.0);
}

/// An end that stands too high for the outline, as of a tilted last, is not found. And where
/// cameras look from one side only, an end of the foot does not tell its axis: of a scan, to which
/// points were put where no camera saw any; normals in other files need not point outwards.
Result<void> check_ends(const FootScan& foot) {
  constexpr double kNoStrays = 0.03;
  if (const double beyond = share_beyond_ends(foot); beyond > kNoStrays) {
    return fail(
        ErrorCode::kInsufficientData,
        "the ends of the foot were not found: " + in_percent(beyond) +
            " of its points lie beyond them",
        "measure one whole foot that stands on its sole, with more points on heel and toes");
  }
  if (!foot.cloud.stands_on_platform()) return {};
  const auto half = unseen_half(foot);
  if (!half) return {};
  return fail(ErrorCode::kInsufficientData,
              "the foot was seen from one side only, with nothing of " + *half +
                  ", so that nobody can tell which way it points",
              "let cameras on both sides see it, and give all that they saw");
}

std::vector<std::string> doubts(const FootScan& foot) {
  std::vector<std::string> warnings;
  if (!foot.landmarks.contains("toe2_tip")) {
    warnings.emplace_back("the toes were not seen: scan the foot again, in full view");
  } else if (!foot.has_seen_toes()) {
    warnings.emplace_back(
        "the toes cannot be told apart: the second toe's tip is placed by proportion");
  }
  return warnings;
}

/// Takes the axis that was found for the foot's own, and says so where another was asked for.
void settle_for(FootScan& foot, AxisRule found) {
  if (foot.rules.axis == found) return;
  foot.warnings.push_back("the axis " + std::string(name_of(foot.rules.axis, kAxisRules)) +
                          " was not found: " + std::string(name_of(found, kAxisRules)) +
                          " is used");
  foot.rules.axis = found;
}

/// Moves the foot into the frame of an axis and sets its ends.
void take_axis(FootScan& foot, const FootAxis& axis, const RigidTransform& standing_from_cloud) {
  const RigidTransform foot_from_cloud = axis.foot_from_standing * standing_from_cloud;
  foot.foot_from_input = foot_from_cloud * foot.foot_from_input;
  foot.cloud = transformed(foot_from_cloud, foot.cloud);
  if (foot.quieted) foot.quieted->cloud = transformed(foot_from_cloud, foot.quieted->cloud);
  foot.landmarks.clear();
  foot.landmarks["pternion"] =
      axis.is_heel_seen
          ? Landmark{axis.pternion, 1.0, "rearmost point of the heel along the axis"}
          : Landmark{axis.pternion, 0.5,
                     "midway between the borders of the heel, whose end was not seen"};
  foot.landmarks["acropodion"] = {axis.acropodion, 1.0,
                                  "foremost point of the toes along the axis"};
  if (!axis.toe2_tip) return;
  foot.landmarks["toe2_tip"] =
      axis.is_second_toe_resolved
          ? Landmark{*axis.toe2_tip, 0.9, "summit of the second toe on the front border"}
          : Landmark{*axis.toe2_tip, 0.4,
                     "front border at 0.415 of the ball's breadth from medial"};
}

/// Puts the floor as much below what was seen as the walls' ends tell.
Result<void> stand_deeper(FootScan& foot) {
  const auto below = floor_below(foot);
  if (!below) {
    return fail(ErrorCode::kInsufficientData,
                "the lowest part of the foot was not seen: where its walls end they do not yet "
                "bend under it, so that nobody can tell how far below the floor is",
                "keep what lies within 5 mm of the floor in the cloud, and better some floor too");
  }
  foot.floor_below = *below;
  const RigidTransform higher(Eigen::Translation3d(0.0, 0.0, foot.floor_below.depth_mm));
  foot.foot_from_input = higher * foot.foot_from_input;
  foot.cloud = transformed(higher, foot.cloud);
  if (foot.quieted) foot.quieted->cloud = transformed(higher, foot.quieted->cloud);
  for (auto& [name, landmark] : foot.landmarks) {
    landmark.position_mm = higher * landmark.position_mm;
  }
  return {};
}

/// A foot's cloud put into its own frame, if it stands on a plane.
Result<FootScan> aligned(FootScan foot, const StandingPlane& plane,
                         const AlignmentOptions& options) {
  const RigidTransform standing_from_input = plane.standing_from_input();
  const auto standing = transformed(standing_from_input, foot.shape()).positions;

  const auto outline = find_outline_axis(standing);
  if (!outline) return tl::unexpected(outline.error());
  auto along_outline = standing;
  for (auto& point : along_outline) point = outline->axis_from_standing() * point;
  SideGuess guess = side_from_shape(along_outline, outline->length_mm);
  if (!foot.cloud.stands_on_platform()) {
    guess = guess_by_seen_borders(guess, along_outline, outline->length_mm);
  }
  foot.side = options.side.value_or(guess.side);
  foot.side_confidence = options.side ? 1.0 : guess.confidence;

  foot.is_floor_known = options.standing_plane && !options.is_plane_guessed;
  const FootAxis axis = find_foot_axis(standing, *outline, foot.side, options.rules.axis);
  take_axis(foot, axis, standing_from_input);
  foot.rules = options.rules;
  foot.warnings = doubts(foot);
  if (foot.rules != MeasuringRules{}) {
    foot.warnings.push_back("measured by definitions of one's own choice: " + in_words(foot.rules));
  }
  settle_for(foot, axis.rule);
  if (foot.side != guess.side && guess.confidence > kSureSide) {
    foot.warnings.push_back(
        "measured as a " + std::string(to_string(foot.side)) + " foot, " +
        (options.is_side_by_place ? "as it stands beside the other" : "as asked for") +
        ", but its shape is that of a " + to_string(guess.side) + " one: check " +
        (options.is_side_by_place ? "that the feet are not crossed" : "the side"));
  }
  if (auto checked = check_ends(foot); !checked) return tl::unexpected(checked.error());
  if (is_sole_open(foot)) {
    if (auto stood = stand_deeper(foot); !stood) return tl::unexpected(stood.error());
    close_open_sole(foot);
  }
  return foot;
}

/// A body stood on its lowest points along the file's z, or against it, if it is a last then.
std::optional<FootScan> last_standing(const FootScan& body, const AlignmentOptions& options,
                                      const Eigen::Vector3d& up) {
  auto last = aligned(body, plane_below(body.shape().positions, up), options);
  if (!last || !is_shoe_last(*last)) return std::nullopt;
  return *std::move(last);
}

/// It is not flat, so that nothing can be put in its place.
tl::unexpected<Error> bottom_not_seen() {
  return fail(ErrorCode::kInsufficientData,
              "the bottom of this shoe last was not seen, and nothing else tells its shape",
              "scan it from below as well, or measure a file with all of it");
}

/// A last has no flat sole to be found by; files of lasts have z up, or down. Upside down no last
/// passes for one: both its ends are high then. Else what was found, but for a last: it rests on
/// heel and ball, or on its top, not as in its shoe.
Result<FootScan> as_last(const FootScan& body, const AlignmentOptions& options,
                         Result<FootScan> found) {
  if (auto last = last_standing(body, options, Eigen::Vector3d::UnitZ())) {
    if (last->cloud.stands_on_platform()) return bottom_not_seen();
    last->warnings.emplace_back(
        "how the last stands is taken from its file: by z, which points up");
    return *std::move(last);
  }
  if (auto last = last_standing(body, options, -Eigen::Vector3d::UnitZ())) {
    if (last->cloud.stands_on_platform()) return bottom_not_seen();
    last->warnings.emplace_back(
        "the last stands upside down in its file and was turned over: how it stands is taken from "
        "z, which points down");
    return *std::move(last);
  }
  if (!found) return found;
  if (is_shoe_last(*found)) {
    return fail(ErrorCode::kInvalidInput,
                "this is a shoe last that stands askew in its file, and nothing but the file tells "
                "how it stands in its shoe",
                "turn it so that z points up as it stands in its shoe");
  }
  found->warnings.emplace_back(
      "no toes were seen and no sole lies flat on the floor: if this is a last, turn it so that z "
      "points up as it stands in its shoe; if it is a foot, see that its sole is in the cloud");
  return found;
}

/// The floor of a foot whose floor was found before, from the points that it has now.
StandingPlane floor_again(const FootScan& foot) {
  const auto& points = foot.shape().positions;
  if (foot.is_floor_known) return {};
  // A last has no flat sole to settle on: it was stood on its lowest points.
  if (is_shoe_last(foot)) return plane_below(points, Eigen::Vector3d::UnitZ());
  return plane_again(points, foot.length_mm());
}

/// A refusal of points in lines: what is missed may lie between them.
Error said_of_lines(Error refusal, const ScannerLines& lines) {
  refusal.advice += "; the points stand in lines " + in_millimetres(lines.pitch_mm) +
                    " apart: if all else is right, have them closer";
  return refusal;
}

/// A refusal of points among strays, of which some may have been left for skin.
Error said_of_strays(Error refusal, const FootAlone& alone) {
  refusal.advice += "; " + in_percent(alone.stray_share) +
                    " of the points are strays off the skin: see to what shines or moves first";
  return refusal;
}

}  // namespace

Result<FootScan> align_foot(const PointCloud& cloud, const AlignmentOptions& told) {
  if (auto checked = check_cloud(cloud); !checked) return tl::unexpected(checked.error());
  if (auto checked = check_options(told); !checked) return tl::unexpected(checked.error());
  auto alone = foot_alone(cloud, told.standing_plane || told.up, told.is_one_foot);
  if (!alone) return tl::unexpected(alone.error());
  AlignmentOptions options = told;
  if (alone->floor) options.standing_plane = alone->floor;
  FootScan foot;
  foot.cloud = std::move(alone->cloud);
  if (normals_contradict_shape(foot.cloud)) {
    foot.cloud.drop_normals();
    alone->warnings.emplace_back(
        "the normals that came with the points contradict the shape or point inwards, and were not "
        "used: have them made anew, or leave them out of the file");
  }
  foot.lines = scanner_lines(foot.cloud.positions);
  if (foot.lines) {
    alone->warnings.push_back("the points stand in lines " + in_millimetres(foot.lines->pitch_mm) +
                              " apart, and what lies between them was not seen: set the "
                              "scanner's lines closer, or move it more slowly or nearer");
  }
  if (const auto noise_mm = moving_noise_mm(foot.cloud, foot.lines)) {
    foot.quieted = quieted(foot.cloud, {*noise_mm, rough_length_mm(foot.cloud)});
  }
  const auto plane =
      alone->plane && !foot.quieted ? *alone->plane : standing_plane(foot.shape(), options);
  auto found = plane ? aligned(foot, *plane, options) : tl::make_unexpected(plane.error());
  const bool may_be_last = !found || (!found->has_seen_toes() && !stands_flat(*found));
  if (may_be_last && !options.standing_plane && !options.up)
    found = as_last(foot, options, std::move(found));
  if (!found && alone->had_many_strays()) {
    return tl::unexpected(said_of_strays(found.error(), *alone));
  }
  if (!found && foot.lines) return tl::unexpected(said_of_lines(found.error(), *foot.lines));
  if (!found) return found;
  found->warnings.insert(found->warnings.end(), alone->warnings.begin(), alone->warnings.end());
  return found;
}

FootScan aligned_as(const FootScan& foot, PointCloud cloud) {
  FootScan other;
  other.cloud = std::move(cloud);
  other.side = foot.side;
  other.side_confidence = foot.side_confidence;
  other.is_floor_known = foot.is_floor_known;
  other.rules = foot.rules;
  for (const char* name : {"pternion", "acropodion", "toe2_tip"}) {
    const auto found = foot.landmarks.find(name);
    if (found != foot.landmarks.end()) other.landmarks.insert(*found);
  }
  return other;
}

bool realign(FootScan& foot, double deeper_mm) {
  StandingPlane floor = floor_again(foot);
  floor.height_mm -= deeper_mm;
  const RigidTransform standing_from_cloud = floor.standing_from_input();
  OutlineAxis start;
  start.length_mm = foot.length_mm();
  const auto standing = transformed(standing_from_cloud, foot.shape()).positions;
  const FootAxis axis = find_foot_axis(standing, start, foot.side, foot.rules.axis);
  if (axis.rule != foot.rules.axis) return false;
  take_axis(foot, axis, standing_from_cloud);
  return true;
}

}  // namespace instep
