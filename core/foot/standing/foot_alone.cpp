#include "core/foot/standing/foot_alone.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "core/foot/cloud/left_out_strays.h"
#include "core/foot/standing/plane_under_foot.h"
#include "core/foot/standing/seen_floor.h"
#include "core/foot/standing/standing_body.h"
#include "core/foot/standing/whole_leg.h"
#include "core/geometry/distinct_points.h"
#include "core/in_millimetres.h"
#include "core/in_percent.h"
#include "core/picked.h"

namespace instep {
namespace {

constexpr std::size_t kFewestPoints = 200;
constexpr double kLargePieceShare = 0.1;   ///< a piece apart that is worth a word
constexpr double kLargeBesideShare = 0.5;  ///< of the foot, that touches it
constexpr double kManyStrays = 0.005;      ///< of the points, that are worth a word
constexpr double kUprightLeg = 0.866;      ///< cosine: of a leg, on the sole

Result<void> check_count(const PointCloud& cloud) {
  if (cloud.size() >= kFewestPoints) return {};
  return fail(ErrorCode::kInsufficientData,
              "the cloud has only " + std::to_string(cloud.size()) + " points",
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

void leave_strays_out_of(FootAlone& foot) {
  const LeftOutStrays left_out = leave_out_strays(foot.cloud);
  if (left_out.any_clump) {
    foot.warnings.emplace_back(
        "a small clump of points that no skin reaches is left out: if it is the end of a toe or of "
        "the heel, turn a camera to what lies between");
  }
  foot.stray_share = left_out.share;
  if (!foot.had_many_strays()) return;
  foot.warnings.push_back(in_percent(left_out.share) +
                          " of the points are strays off the skin and are left out: see to what "
                          "shines or moves, and to the cameras' poses");
}

/// Of the largest body, for things that stand in line with a foot look like a leg.
std::optional<FootUnderLeg> foot_of_largest(const PointCloud& cloud, bool is_one_foot) {
  if (!foot_under_leg(cloud.positions)) return std::nullopt;
  const auto body = standing_body(cloud.positions, is_one_foot).points;
  auto foot = foot_under_leg(picked(cloud.positions, body));
  if (foot) foot->points = picked(body, foot->points);
  return foot;
}

/// It would be taken for a body that lies on its side. Across one that leans toes would be left out
/// with it.
void leave_out_leg(bool is_one_foot, FootAlone& foot) {
  const auto under = foot_of_largest(foot.cloud, is_one_foot);
  if (!under) return;
  PointCloud rest = foot.cloud.subset(under->points);
  auto plane = plane_under_foot(rest);
  if (plane && plane->up.dot(under->up) < kUprightLeg) return;
  foot.cloud = std::move(rest);
  foot.plane = std::move(plane);
  foot.warnings.push_back("the cloud holds most of a leg: what lies more than " +
                          in_millimetres(under->kept_mm) + " from the sole along it was left out");
}

/// That nobody told of, near to the plane that was found under all points.
void leave_out_floor(FootAlone& foot) {
  const auto floor = seen_floor(foot.cloud.positions, **foot.plane);
  if (!floor) return;
  foot.floor = floor->plane;
  foot.cloud = foot.cloud.subset(floor->above);
  foot.warnings.emplace_back("the floor round the foot was left out; heights are taken over it");
}

std::string beside(const StandingBody& body) {
  if (body.is_gap_seen) {
    return "something stands " + in_millimetres(body.gap_beside_mm) +
           " beside the foot and is left out; it may hide skin: take it away and scan again";
  }
  return "something touches the foot, or nearly does; it is left out as far as the points tell it "
         "from skin: take it away and scan again";
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
  if (body.gap_beside_mm > 0.0) warnings.push_back(beside(body));
}

/// Other bodies. A plane that was found under all points is none of the foot's then.
Result<void> leave_out_others(bool is_one_foot, FootAlone& foot) {
  const StandingBody body = standing_body(foot.cloud.positions, is_one_foot);
  if (auto checked = check_beside(body); !checked) return checked;
  if (body.points.size() < foot.cloud.size()) foot.plane.reset();
  foot.cloud = foot.cloud.subset(body.points);
  warn_of(body, foot.warnings);
  return {};
}

}  // namespace

bool FootAlone::had_many_strays() const {
  return stray_share > kManyStrays;
}

Result<FootAlone> foot_alone(const PointCloud& cloud, bool is_told, bool is_one_foot) {
  FootAlone foot;
  // Files of triangles name a corner once for each face.
  foot.cloud = cloud.subset(distinct_points(cloud));
  leave_strays_out_of(foot);
  if (auto checked = check_count(foot.cloud); !checked) return tl::unexpected(checked.error());
  if (!is_told) {
    leave_out_leg(is_one_foot, foot);
    if (!foot.plane) foot.plane = plane_under_foot(foot.cloud);
    if (*foot.plane) leave_out_floor(foot);
    if (foot.floor) foot.plane.reset();
    if (auto checked = check_count(foot.cloud); !checked) return tl::unexpected(checked.error());
  }
  if (auto alone = leave_out_others(is_one_foot, foot); !alone)
    return tl::unexpected(alone.error());
  if (auto checked = check_count(foot.cloud); !checked) return tl::unexpected(checked.error());
  return foot;
}

}  // namespace instep
