#include "core/foot/alignment.h"

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "core/foot/foot_axis.h"
#include "core/foot/full_size.h"
#include "core/foot/left_out_strays.h"
#include "core/foot/normals_of_shape.h"
#include "core/foot/open_sole.h"
#include "core/foot/outline_axis.h"
#include "core/foot/seen_floor.h"
#include "core/foot/shoe_last.h"
#include "core/foot/side_from_shape.h"
#include "core/foot/standing_body.h"
#include "core/foot/unseen_half.h"
#include "core/foot/whole_leg.h"
#include "core/geometry/distinct_points.h"
#include "core/geometry/extent.h"
#include "core/geometry/moments.h"
#include "core/in_millimetres.h"
#include "core/some_of.h"

namespace instep {
namespace {

constexpr std::size_t kFewestPoints = 200;
constexpr std::size_t kPointsOfLength = 10000;
constexpr double kLargePieceShare = 0.1;   ///< a piece apart that is worth a word
constexpr double kLargeBesideShare = 0.5;  ///< of the foot, that touches it
constexpr double kManyStrays = 0.002;      ///< of the points, that are worth a word

std::vector<Eigen::Vector3d> scaled(std::vector<Eigen::Vector3d> points, double factor) {
  for (auto& point : points) point *= factor;
  return points;
}

/// Along the direction in which the points spread most.
double longest_extent(const std::vector<Eigen::Vector3d>& points) {
  Moments moments;
  for (const auto& point : points) moments.add(point - points.front());
  const Eigen::Vector3d along = moments.axes().eigenvectors().col(2);
  return extent_along(points, along).length();
}

/// Of a foot of about that length, told at full size.
Result<StandingPlane> plane_at_size(const PointCloud& cloud, double length_mm) {
  const double factor = full_size_factor(length_mm);
  return find_standing_plane(scaled(cloud.positions, factor)).map([&](StandingPlane found) {
    found.height_mm /= factor;
    return found;
  });
}

/// How long a foot is shows once it stands, and some of its points tell it as well.
std::optional<double> rough_length(const PointCloud& cloud) {
  const PointCloud some = cloud.subset(some_of(cloud.size(), kPointsOfLength));
  const auto plane = plane_at_size(some, longest_extent(some.positions));
  if (!plane) return std::nullopt;
  const auto outline = find_outline_axis(transformed(plane->standing_from_input(), some).positions);
  return outline ? std::optional(outline->length_mm) : std::nullopt;
}

double length_for_now(const PointCloud& cloud) {
  const auto length = rough_length(cloud);
  return length ? *length : longest_extent(cloud.positions);
}

/// How it stands shows once its size is known.
Result<StandingPlane> plane_under(const PointCloud& cloud) {
  return plane_at_size(cloud, length_for_now(cloud));
}

Result<StandingPlane> standing_plane(const PointCloud& cloud, const AlignmentOptions& options) {
  if (options.standing_plane) return *options.standing_plane;
  if (options.up) return plane_below(cloud.positions, *options.up);
  return plane_under(cloud);
}

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

tl::unexpected<Error> too_few(std::size_t points) {
  return fail(ErrorCode::kInsufficientData,
              "the cloud has only " + std::to_string(points) + " points",
              "give at least " + std::to_string(kFewestPoints) + " points of one foot");
}

/// Where another foot or a wall touches, too much of the border is nobody's.
Result<void> check_beside(const StandingBody& body) {
  if (body.gap_beside_mm == 0.0 || body.is_gap_seen || body.beside_share < kLargeBesideShare) {
    return {};
  }
  return fail(ErrorCode::kInvalidInput,
              "something large touches the foot, so that the points do not tell where it ends",
              "move them apart and scan again, or give the points of one foot alone");
}

/// Where cameras look from one side only, an end of the foot does not tell its axis. Of a scan, to
/// which points were put where no camera saw any; normals in other files need not point outwards.
Result<void> check_ends(const FootScan& foot) {
  if (!foot.cloud.stands_on_platform()) return {};
  const auto half = unseen_half(foot);
  if (!half) return {};
  return fail(ErrorCode::kInsufficientData,
              "the foot was seen from one side only, with nothing of " + *half +
                  ", so that nobody can tell which way it points",
              "let cameras on both sides see it, and give all that they saw");
}

std::string beside(const StandingBody& body) {
  if (body.is_gap_seen) {
    return "something stands " + in_millimetres(body.gap_beside_mm) +
           " beside the foot and is left out; it may hide skin: take it away and scan again";
  }
  return "something touches the foot, or nearly does; it is left out as far as the points tell it "
         "from skin: take it away and scan again";
}

std::string strays_left_out(double share) {
  char percent[16];
  std::snprintf(percent, sizeof percent, "%.1f %%", 100.0 * share);
  return std::string(percent) +
         " of the points are strays off the skin and are left out: see to what shines or moves, "
         "and "
         "to the cameras' poses";
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

/// A foot's cloud put into its own frame, if it stands on a plane.
Result<FootScan> aligned(FootScan foot, const StandingPlane& plane,
                         const AlignmentOptions& options) {
  const RigidTransform standing_from_input = plane.standing_from_input();
  const auto standing = transformed(standing_from_input, foot.shape()).positions;

  const auto outline = find_outline_axis(standing);
  if (!outline) return tl::unexpected(outline.error());
  auto along_outline = standing;
  for (auto& point : along_outline) point = outline->axis_from_standing() * point;
  const SideGuess guess = side_from_shape(along_outline, outline->length_mm);
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
    foot.warnings.push_back("measured as a " + std::string(to_string(foot.side)) +
                            " foot, as asked for, but its shape is that of a " +
                            to_string(guess.side) + " one: check the side");
  }
  if (auto checked = check_ends(foot); !checked) return tl::unexpected(checked.error());
  if (is_sole_open(foot)) close_open_sole(foot);
  return foot;
}

/// A body stood on its lowest points along the file's z, or against it, if it is a last then.
std::optional<FootScan> last_standing(const FootScan& body, const AlignmentOptions& options,
                                      const Eigen::Vector3d& up) {
  auto last = aligned(body, plane_below(body.shape().positions, up), options);
  if (!last || !is_shoe_last(*last)) return std::nullopt;
  return *std::move(last);
}

/// A last has no flat sole to be found by; files of lasts have z up, or down. Upside down no last
/// passes for one: both its ends are high then. Else what was found, but for a last: it rests on
/// heel and ball, or on its top, not as in its shoe.
Result<FootScan> as_last(const FootScan& body, const AlignmentOptions& options,
                         Result<FootScan> found) {
  if (auto last = last_standing(body, options, Eigen::Vector3d::UnitZ())) {
    last->warnings.emplace_back(
        "how the last stands is taken from its file: by z, which points up");
    return *std::move(last);
  }
  if (auto last = last_standing(body, options, -Eigen::Vector3d::UnitZ())) {
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
  const double factor = full_size_factor(foot.landmarks.at("acropodion").position_mm.x());
  StandingPlane sole = settled_on_sole(scaled(points, factor), {});
  sole.height_mm /= factor;
  return sole;
}

void warn_of(const StandingBody& body, std::vector<std::string>& warnings) {
  if (body.parts > 1) {
    warnings.push_back(
        "the foot comes in " + std::to_string(body.parts) +
        " parts: no camera saw what joins them, and what lies between is guessed; turn one to it");
  }
  if (body.next_share > kLargePieceShare) {
    warnings.push_back("the cloud holds more than one body: the largest is measured, " +
                       std::to_string(std::lround(100.0 * body.apart_share)) +
                       " % of the points are left out");
  }
}

/// Leaves out a floor that nobody told of, near to the plane that was found under all points; from
/// then on it is known. False if none was seen.
bool take_off_floor(const StandingPlane& plane, PointCloud& cloud, AlignmentOptions& options) {
  if (options.standing_plane || options.up) return false;
  const auto floor = seen_floor(cloud.positions, plane);
  if (!floor) return false;
  options.standing_plane = floor->plane;
  cloud = cloud.subset(floor->above);
  return true;
}

/// Leaves out most of a leg, which would be taken for a body that lies on its side. Where it is
/// known which way is up a leg does no harm. What to warn of, if so.
std::optional<std::string> take_off_leg(const AlignmentOptions& options, PointCloud& cloud) {
  if (options.standing_plane || options.up) return std::nullopt;
  const auto foot = foot_under_leg(cloud.positions);
  if (!foot) return std::nullopt;
  cloud = cloud.subset(foot->points);
  return "the cloud holds most of a leg: what lies more than " + in_millimetres(foot->kept_mm) +
         " from the sole along it was left out";
}

}  // namespace

Result<FootScan> align_foot(const PointCloud& cloud, const AlignmentOptions& told) {
  if (auto checked = check_cloud(cloud); !checked) return tl::unexpected(checked.error());
  if (auto checked = check_options(told); !checked) return tl::unexpected(checked.error());
  FootScan foot;
  // Files of triangles name a corner once for each face.
  foot.cloud = cloud.subset(distinct_points(cloud));
  const double stray_share = leave_out_strays(foot.cloud);
  if (foot.cloud.size() < kFewestPoints) return too_few(foot.cloud.size());
  const auto leg = take_off_leg(told, foot.cloud);
  AlignmentOptions options = told;
  auto plane = standing_plane(foot.cloud, options);
  const bool is_floor_seen = plane && take_off_floor(*plane, foot.cloud, options);
  if (foot.cloud.size() < kFewestPoints) return too_few(foot.cloud.size());
  const StandingBody body = standing_body(foot.cloud.positions, options.is_one_foot);
  if (auto checked = check_beside(body); !checked) return tl::unexpected(checked.error());
  const bool is_plane_of_body = !is_floor_seen && body.points.size() == foot.cloud.size();
  foot.cloud = foot.cloud.subset(body.points);
  if (foot.cloud.size() < kFewestPoints) return too_few(foot.cloud.size());
  const bool drops_normals = normals_contradict_shape(foot.cloud);
  if (drops_normals) foot.cloud.drop_normals();
  if (const auto noise_mm = moving_noise_mm(foot.cloud)) {
    foot.quieted = quieted(foot.cloud, {*noise_mm, length_for_now(foot.cloud)});
  }
  if (foot.quieted || !is_plane_of_body) plane = standing_plane(foot.shape(), options);
  auto found = plane ? aligned(foot, *plane, options) : tl::make_unexpected(plane.error());
  const bool may_be_last = !found || (!found->has_seen_toes() && !stands_flat(*found));
  if (may_be_last && !options.standing_plane && !options.up)
    found = as_last(foot, options, std::move(found));
  if (!found) return found;
  if (leg) found->warnings.push_back(*leg);
  if (is_floor_seen) {
    found->warnings.emplace_back(
        "the floor round the foot was left out; heights are taken over it");
  }
  if (stray_share > kManyStrays) found->warnings.push_back(strays_left_out(stray_share));
  warn_of(body, found->warnings);
  if (drops_normals) {
    found->warnings.emplace_back(
        "the normals that came with the points contradict the shape or point inwards, and were not "
        "used: have them made anew, or leave them out of the file");
  }
  if (body.gap_beside_mm > 0.0) found->warnings.push_back(beside(body));
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

bool realign(FootScan& foot) {
  const StandingPlane floor = floor_again(foot);
  const RigidTransform standing_from_cloud = floor.standing_from_input();
  OutlineAxis start;
  start.length_mm = foot.landmarks.at("acropodion").position_mm.x();
  const auto standing = transformed(standing_from_cloud, foot.shape()).positions;
  const FootAxis axis = find_foot_axis(standing, start, foot.side, foot.rules.axis);
  if (axis.rule != foot.rules.axis) return false;
  take_axis(foot, axis, standing_from_cloud);
  return true;
}

}  // namespace instep
