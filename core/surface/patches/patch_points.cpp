#include "core/surface/patches/patch_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry/point_spacing.h"
#include "core/mean.h"
#include "core/median.h"
#include "core/picked.h"
#include "core/stride.h"

namespace instep {
namespace {

/// Of the points of a patch, the half.
constexpr std::size_t kNearerPart = 2;
/// A place whose points have their middle further off, against their reach, lies in a hole.
constexpr double kOneSided = 0.5;
/// In steps of this many halves.
constexpr std::size_t kMoreInAHole = 3;
/// Nearest points that tell which way is out.
constexpr std::size_t kFacingPoints = 8;
/// Cosine to that direction from which a point can be a height over the patch, and below which it
/// lies on the other side of a thin part.
constexpr double kFacing = 0.5;
constexpr double kBehind = -0.3;
/// The same of normals that tell of no crease, and how many, and which part of all, must tell of
/// one.
constexpr double kHardlyBent = 0.93;
constexpr std::ptrdiff_t kFewestBent = 6;
constexpr double kLeastBent = 0.05;
/// With more than this part of the points on the other side, a part is thin.
constexpr double kThin = 0.1;
/// Points nearer to each other than this part of the spacing are copies of one.
constexpr double kTwin = 0.02;
/// Heights this many median deviations off, and this part of the radius, are those of strays.
constexpr double kStrayDeviations = 5.0;
constexpr double kStrayRise = 0.7;
/// Points seen along the normal within a patch's width lie within this many widths in space.
constexpr double kRoundBends = 1.1;

/// Told normals do for some more points.
constexpr PatchRule kByPoints = {.points = 60, .points_in_space = 80};
constexpr PatchRule kByToldNormals = {.points = 40, .points_in_space = 40};
/// Noise, as a standard deviation, against the spacing. Girths of bare lasts of 3,560 points with
/// 0.1 mm of it, a fortieth of the spacing, err 0.22 mm in place of 0.39. With a limit of 0.08
/// those with 0.3 mm gain as well, but simulated feet of 1,080 points with 0.5 mm err 1.07 mm in
/// place of 0.91.
constexpr double kQuiet = 0.05;

/// Mean distance from a point to the nearest other one, against the spacing: half of it for points
/// at random, a quarter on lines sixteen times as far apart as their points.
constexpr double kStrung = 0.4;

/// Square of how far a point is from a place, seen along `outward`, as wide patches ask: in space,
/// noise would choose the points at the rim: on a bent surface those that stand out are nearer than
/// those that lie low, and a patch of them lies too low by about the variance over the radius of
/// curvature.
double square_beside(const Eigen::Vector3d& place, const Eigen::Vector3d& point,
                     const Eigen::Vector3d& outward) {
  return outward.cross(point - place).squaredNorm();
}

}  // namespace

PatchPoints::PatchPoints(std::vector<OrientedPoint> points, PointIndex index,
                         std::vector<LocalRoughness> roughness)
    : points_(std::move(points)),
      index_(std::move(index)),
      roughness_(std::move(roughness)),
      told_(all_tell_normals(points_)),
      rule_(told_ ? kByToldNormals : kByPoints) {}

/// Whether the nearest points lie closer together on lines than from line to line.
bool PatchPoints::are_strung(const Surroundings& surroundings) const {
  const auto& nearest = surroundings.nearest;
  const std::size_t stride = stride_to_at_least(rule_.points, nearest.size());
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < nearest.size(); i += stride) {
    const Eigen::Vector3d& place = points_[nearest[i].index].position;
    double square = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < nearest.size(); ++j) {
      if (j == i) continue;
      square = std::min(square, (points_[nearest[j].index].position - place).squaredNorm());
    }
    sum += std::sqrt(square);
    count += 1.0;
  }
  return sum < kStrung * surroundings.spacing * count;
}

bool PatchPoints::are_clear(const Surroundings& surroundings) const {
  return !told_ && surroundings.quiet && !are_strung(surroundings);
}

bool PatchPoints::are_bent(const Members& members) const {
  const auto bent = std::count_if(members.all.begin(), members.all.end(), [&](std::size_t i) {
    return points_[i].normal.dot(members.outward) < kHardlyBent;
  });
  const auto least = kLeastBent * static_cast<double>(members.all.size());
  return bent >= kFewestBent && static_cast<double>(bent) >= least;
}

const CreaseRule& PatchPoints::crease_rule(bool clear) const {
  if (told_) return kToldCrease;
  return clear ? kClearCrease : kNoisyCrease;
}

std::size_t PatchPoints::nearer_points() const {
  return rule_.points / kNearerPart;
}

/// Over which distance noise and roughness weigh the same.
double PatchPoints::Surroundings::bandwidth(double of_roughness) const {
  return std::pow(noise_area / of_roughness, 0.2);
}

/// The nearest points; more of them in a hole, until they lie on all sides, so that the surface
/// spans it and is not put forth from one side.
PatchPoints::Neighbours PatchPoints::nearest_all_round(const Eigen::Vector3d& place) const {
  auto first = index_.nearest(place, rule_.points);
  auto nearest = first;
  for (std::size_t count = kMoreInAHole * rule_.points / 2;; count = kMoreInAHole * count / 2) {
    const Eigen::Vector3d middle =
        mean_of(nearest, [&](const auto& neighbour) { return points_[neighbour.index].position; });
    const double reach = std::sqrt(nearest.back().squared_distance);
    if ((middle - place).norm() < kOneSided * reach || is_thin(nearest)) return nearest;
    if (reach > kWidestHole || nearest.size() == points_.size()) return first;
    nearest = index_.nearest(place, count);
  }
}

PatchPoints::Surroundings PatchPoints::surroundings_of(const Eigen::Vector3d& place) const {
  Surroundings here;
  here.nearest = nearest_all_round(place);
  here.reach = std::sqrt(here.nearest.back().squared_distance);
  here.outward = outward_of(here.nearest);
  const std::size_t count = std::min(kFacingPoints, here.nearest.size());
  double variance = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    variance += points_[here.nearest[i].index].variance / static_cast<double>(count);
  }
  here.spacing = spacing_within(here.reach, here.nearest.size());
  here.noise_area = variance * here.spacing * here.spacing;
  here.roughness = roughness_at(roughness_, place);
  here.exact =
      is_harmless(variance, here.spacing, points_[here.nearest.front().index].surely_noise);
  here.quiet = variance <= std::pow(kQuiet * here.spacing, 2);
  return here;
}

/// Leaves out points that stand off from the others by more than a bend or a crease could.
void PatchPoints::drop_strays(Members& members) const {
  std::vector<double> heights;
  heights.reserve(members.all.size());
  for (const auto i : members.all) heights.push_back(members.outward.dot(points_[i].position));
  if (heights.empty()) return;
  const auto [least, highest] = std::minmax_element(heights.begin(), heights.end());
  if (*highest - *least <= kStrayRise * members.radius) return;
  const double level = median(heights);
  std::vector<double> offsets;
  offsets.reserve(heights.size());
  for (const double height : heights) offsets.push_back(std::abs(height - level));
  const double most = std::max(kStrayDeviations * median(offsets), kStrayRise * members.radius);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (std::abs(heights[i] - level) <= most) members.all[kept++] = members.all[i];
  }
  members.all.resize(kept);
}

void PatchPoints::drop_twins(std::vector<std::size_t>& members, double spacing) const {
  if (members.size() > rule_.points_in_space) return;
  const double nearest = kTwin * spacing;
  std::size_t kept = 0;
  for (const auto member : members) {
    const auto is_twin = [&](std::size_t other) {
      const Eigen::Vector3d arm = points_[member].position - points_[other].position;
      return arm.squaredNorm() < nearest * nearest;
    };
    const auto end = members.begin() + static_cast<std::ptrdiff_t>(kept);
    if (std::none_of(members.begin(), end, is_twin)) members[kept++] = member;
  }
  members.resize(kept);
}

PatchPoints::Members PatchPoints::members_of(const Surroundings& surroundings,
                                             const Eigen::Vector3d& place, double width) const {
  const bool wider = width > surroundings.reach;
  const auto found = wider ? index_.around(place, kRoundBends * width) : surroundings.nearest;
  const auto square_of = [&](const OrientedPoint& point) {
    return wider ? square_beside(place, point.position, surroundings.outward)
                 : (point.position - place).squaredNorm();
  };
  Members members;
  members.radius = std::max(width, surroundings.reach);
  members.all.reserve(found.size());
  for (const auto& neighbour : found) {
    const OrientedPoint& point = points_[neighbour.index];
    if (point.normal.dot(surroundings.outward) < kBehind) continue;
    if (wider && square_of(point) > width * width) continue;
    members.all.push_back(neighbour.index);
    members.outward += point.normal;
  }
  members.outward.normalize();
  members.front.reserve(members.all.size());
  drop_strays(members);
  drop_twins(members.all, surroundings.spacing);
  double farthest = 0.0;  // its square
  for (const auto i : members.all) {
    if (!faces(i, members.outward)) continue;
    members.front.push_back(i);
    farthest = std::max(farthest, square_of(points_[i]));
  }
  // Across lines, points lie beyond the reach of those along them, which all have to serve.
  members.front_radius = std::min(std::sqrt(farthest), members.radius);
  return members;
}

PatchPoints::Members PatchPoints::all_round(const Surroundings& surroundings) const {
  Members members;
  members.radius = surroundings.reach;
  for (const auto& neighbour : surroundings.nearest) members.all.push_back(neighbour.index);
  drop_twins(members.all, surroundings.spacing);
  members.outward = surroundings.outward;
  return members;
}

PatchPoints::Members PatchPoints::nearer_of(const Members& members,
                                            const Eigen::Vector3d& place) const {
  Members nearer;
  nearer.all.assign(members.all.begin(),
                    members.all.begin() + static_cast<std::ptrdiff_t>(nearer_points()));
  for (const auto i : nearer.all) nearer.outward += points_[i].normal;
  nearer.outward.normalize();
  nearer.radius = (points_[nearer.all.back()].position - place).norm();
  return nearer;
}

std::vector<OrientedPoint> PatchPoints::at(const std::vector<std::size_t>& indices) const {
  return picked(points_, indices);
}

/// The mean normal of the nearest points on this side of the body: those that do not face away from
/// the nearest one.
Eigen::Vector3d PatchPoints::outward_of(const Neighbours& nearest) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::size_t count = std::min(kFacingPoints, nearest.size());
  const Eigen::Vector3d& first = points_[nearest.front().index].normal;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d& normal = points_[nearest[i].index].normal;
    if (normal.dot(first) > 0.0) sum += normal;
  }
  return sum.normalized();
}

bool PatchPoints::is_thin(const Neighbours& nearest) const {
  const Eigen::Vector3d outward = outward_of(nearest);
  const auto behind = std::count_if(nearest.begin(), nearest.end(), [&](const auto& one) {
    return points_[one.index].normal.dot(outward) < kBehind;
  });
  return static_cast<double>(behind) > kThin * static_cast<double>(nearest.size());
}

bool PatchPoints::faces(std::size_t point, const Eigen::Vector3d& outward) const {
  return points_[point].normal.dot(outward) >= kFacing;
}

}  // namespace instep
