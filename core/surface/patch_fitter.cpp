#include "core/surface/patch_fitter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/median.h"
#include "core/surface/point_lines.h"

namespace instep {
namespace {

/// Of exact points, half of them are asked first for a crease: the further ones tell no more of it,
/// but may lie round a second one or on the other side of a thin part.
constexpr std::size_t kNearerPart = 2;
/// Lines further apart than so many spacings are told from a chance gap.
constexpr double kLinesApart = 1.5;
/// A place whose points have their middle further off, against their reach, lies in a hole; holes
/// wider than this part of the body are not spanned.
constexpr double kOneSided = 0.5;
constexpr double kWidestHole = 0.2;
/// In steps of this many halves.
constexpr std::size_t kMoreInAHole = 3;
/// Nearest points that tell which way is out.
constexpr std::size_t kFacingPoints = 8;
/// Cosine to that direction from which a point can be a height over the patch, and below which it
/// lies on the other side of a thin part.
constexpr double kFacing = 0.5;
constexpr double kBehind = -0.3;
/// With more than this part of the points on the other side, the patch is one in space.
constexpr double kThin = 0.1;
/// How far its surface may be off: the variance half-way between points, against roughness times
/// the cube of their spacing, and how many points share in averaging noise.
constexpr double kWanderingInSpace = 0.1;
constexpr int kAveragedInSpace = 6;
/// Points nearer to each other than this part of the spacing are copies of one.
constexpr double kTwin = 0.02;
/// A patch is at least this part of the body wide.
constexpr double kLeastReach = 0.033;
/// Neighbours that reach no further are a crowd: of exact ones a polynomial may tell all. It is
/// made of those within the least reach, or of so many.
constexpr double kCrowdedReach = 0.04;
constexpr std::size_t kFewestOfCrowd = 44;
/// Cosine to the outward direction of normals that tell of no crease, and how many, and which part
/// of all, must tell of one.
constexpr double kHardlyBent = 0.93;
constexpr std::ptrdiff_t kFewestBent = 6;
constexpr double kLeastBent = 0.05;
/// The shape between the estimates of roughness may be rougher than they are.
constexpr double kAllowanceInSpace = 4.0;
/// Heights this many median deviations off, and this part of the radius, are those of strays.
constexpr double kStrayDeviations = 5.0;
constexpr double kStrayRise = 0.7;
/// Where there is noise, a patch is wider than the kriging's bandwidth by this factor, up to this
/// part of the body.
constexpr double kBandwidths = 2.0;
constexpr double kWidest = 0.10;
/// Points seen along the normal within a patch's width lie within this many widths in space.
constexpr double kRoundBends = 1.1;
/// It is fitted again, narrower, if it turns out rougher than thought.
constexpr int kMostAttempts = 5;
constexpr double kTooWide = 1.5;
/// Or wider, if the points determine no surface yet.
constexpr double kWidening = 1.6;
/// Of many exact points: how far off their averages' surface they lie where these blur what the
/// points tell, root mean square against the radius. On scanned feet of 200,000 points girths were
/// 0.10 mm short, and are 0.04 with patches of the nearest ones there.
constexpr double kBlurred = 1e-3;
/// A crease is so much likelier than one smooth sheet.
constexpr double kLeastGain = 8.0;
/// An edge may be round where no points lie: part of what a length over it would lose by that.
constexpr double kRounding = 0.2;

/// Told normals show smaller turns, lead sheets further, and do for some more points.
constexpr PatchRule kByPoints = {
    .points = 60, .points_in_space = 80, .least_turn = 0.9, .widest_gap = 1.4};
constexpr PatchRule kByToldNormals = {
    .points = 40, .points_in_space = 40, .least_turn = 0.4, .widest_gap = 3.0};

Eigen::Vector3d middle_of(const std::vector<OrientedPoint>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points) sum += point.position;
  return sum / static_cast<double>(points.size());
}

/// Square of how far a point is from a place, seen along `outward`, as wide patches ask: in space,
/// noise would choose the points at the rim: on a bent surface those that stand out are nearer than
/// those that lie low, and a patch of them lies too low by about the variance over the radius of
/// curvature.
double square_beside(const Eigen::Vector3d& place, const Eigen::Vector3d& point,
                     const Eigen::Vector3d& outward) {
  return outward.cross(point - place).squaredNorm();
}

/// By how much a length over an edge would be shorter if the edge were as round as its gaps allow,
/// an arc that meets both sheets at their last points, and how likely that is: where they come as
/// near as their spacing lets them, it is sharp.
double rounding_of(const CreasedPatch& creased, double spacing) {
  const double half = 0.5 * creased.turn();
  const double lost = 2.0 * creased.gap() * (1.0 - half / std::tan(half));
  return kRounding * std::min(creased.gap() / spacing, 1.0) * lost;
}

/// Whether a surface through averages of exact points leaves out detail that these tell.
bool blurs(const HeightPatch& sheet, const std::vector<OrientedPoint>& points, double radius) {
  if (!sheet.is_exact() || points.size() <= kMostHeightSamples) return false;
  double squares = 0.0;
  for (const auto& point : points) squares += std::pow(sheet.at(point.position).value, 2);
  const double most = kBlurred * radius;
  return squares > most * most * static_cast<double>(points.size());
}

}  // namespace

PatchFitter::PatchFitter(std::vector<OrientedPoint> points, PointIndex index,
                         std::vector<LocalRoughness> roughness)
    : points_(std::move(points)),
      index_(std::move(index)),
      roughness_(std::move(roughness)),
      rule_(all_tell_normals(points_) ? kByToldNormals : kByPoints) {}

std::size_t PatchFitter::nearer_points() const {
  return rule_.points / kNearerPart;
}

/// Over which distance noise and roughness weigh the same.
double PatchFitter::Surroundings::bandwidth(double of_roughness) const {
  return std::pow(noise_area / of_roughness, 0.2);
}

/// The nearest points; more of them in a hole, until they lie on all sides, so that the surface
/// spans it and is not put forth from one side.
PatchFitter::Neighbours PatchFitter::nearest_all_round(const Eigen::Vector3d& place) const {
  auto first = index_.nearest(place, rule_.points);
  auto nearest = first;
  for (std::size_t count = kMoreInAHole * rule_.points / 2;; count = kMoreInAHole * count / 2) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& neighbour : nearest) middle += points_[neighbour.index].position;
    middle /= static_cast<double>(nearest.size());
    const double reach = std::sqrt(nearest.back().squared_distance);
    if ((middle - place).norm() < kOneSided * reach || is_thin(nearest)) return nearest;
    if (reach > kWidestHole || nearest.size() == points_.size()) return first;
    nearest = index_.nearest(place, count);
  }
}

PatchFitter::Surroundings PatchFitter::surroundings_of(const Eigen::Vector3d& place) const {
  Surroundings here;
  here.nearest = nearest_all_round(place);
  here.reach = std::sqrt(here.nearest.back().squared_distance);
  here.outward = outward_of(here.nearest);
  const std::size_t count = std::min(kFacingPoints, here.nearest.size());
  double variance = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    variance += points_[here.nearest[i].index].variance / static_cast<double>(count);
  }
  const auto found = static_cast<double>(here.nearest.size());
  here.spacing = here.reach * std::sqrt(std::numbers::pi / found);
  here.noise_area = variance * here.spacing * here.spacing;
  here.roughness = roughness_at(roughness_, place);
  here.exact = is_harmless(variance, here.spacing);
  return here;
}

/// Leaves out points that stand off from the others by more than a bend or a crease could.
void PatchFitter::drop_strays(Members& members) const {
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

/// Leaves out points that nearly repeat another: the slope between the two would be one of
/// rounding.
void PatchFitter::drop_twins(std::vector<std::size_t>& members, double nearest) const {
  if (members.size() > rule_.points_in_space) return;
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

PatchFitter::Members PatchFitter::members_of(const Surroundings& surroundings,
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
  drop_twins(members.all, kTwin * surroundings.spacing);
  double farthest = 0.0;  // its square
  for (const auto i : members.all) {
    if (points_[i].normal.dot(members.outward) < kFacing) continue;
    members.front.push_back(i);
    farthest = std::max(farthest, square_of(points_[i]));
  }
  // Across lines, points lie beyond the reach of those along them, which all have to serve.
  members.front_radius = std::min(std::sqrt(farthest), members.radius);
  return members;
}

/// The nearer ones of all, which come nearest first.
PatchFitter::Members PatchFitter::nearer_of(const Members& members,
                                            const Eigen::Vector3d& place) const {
  Members nearer;
  nearer.all.assign(members.all.begin(),
                    members.all.begin() + static_cast<std::ptrdiff_t>(nearer_points()));
  for (const auto i : nearer.all) nearer.outward += points_[i].normal;
  nearer.outward.normalize();
  nearer.radius = (points_[nearer.all.back()].position - place).norm();
  return nearer;
}

std::vector<OrientedPoint> PatchFitter::points_at(const std::vector<std::size_t>& indices) const {
  std::vector<OrientedPoint> points;
  points.reserve(indices.size());
  for (const auto i : indices) points.push_back(points_[i]);
  return points;
}

/// The mean normal of the nearest points on this side of the body: those that do not face away from
/// the nearest one.
Eigen::Vector3d PatchFitter::outward_of(const Neighbours& nearest) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::size_t count = std::min(kFacingPoints, nearest.size());
  const Eigen::Vector3d& first = points_[nearest.front().index].normal;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d& normal = points_[nearest[i].index].normal;
    if (normal.dot(first) > 0.0) sum += normal;
  }
  return sum.normalized();
}

/// Whether the points show both sides of a thin part.
bool PatchFitter::is_thin(const Neighbours& nearest) const {
  const Eigen::Vector3d outward = outward_of(nearest);
  const auto behind = std::count_if(nearest.begin(), nearest.end(), [&](const auto& one) {
    return points_[one.index].normal.dot(outward) < kBehind;
  });
  return static_cast<double>(behind) > kThin * static_cast<double>(nearest.size());
}

std::optional<SurfacePatch> PatchFitter::fit_in_space(const Surroundings& surroundings,
                                                      const Eigen::Vector3d& place) const {
  const std::size_t most = rule_.points_in_space;
  const bool wider = surroundings.nearest.size() > most;
  const auto nearest = wider ? surroundings.nearest : index_.nearest(place, most);
  // Of many, an even sample by their distance.
  const std::size_t stride = (nearest.size() + most - 1) / most;
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < nearest.size(); i += stride) members.push_back(nearest[i].index);
  drop_twins(members, kTwin * surroundings.spacing);
  const double radius = std::sqrt(nearest.back().squared_distance);
  auto field = HermitePatch::fit(points_at(members), place, radius,
                                 kAllowanceInSpace * surroundings.roughness);
  if (!field) return std::nullopt;
  const double noise = surroundings.noise_area / (surroundings.spacing * surroundings.spacing);
  const double variance =
      kWanderingInSpace * surroundings.roughness * std::pow(surroundings.spacing, 3) +
      noise / static_cast<double>(kAveragedInSpace);
  return SurfacePatch{place, place, radius, std::move(*field), std::move(members), variance};
}

/// Where the points tell a crease better than one smooth sheet.
std::optional<SurfacePatch> PatchFitter::fit_creased(const Surroundings& surroundings,
                                                     const Eigen::Vector3d& place,
                                                     const Members& members,
                                                     double roughness) const {
  const auto bent = std::count_if(members.all.begin(), members.all.end(), [&](std::size_t i) {
    return points_[i].normal.dot(members.outward) < kHardlyBent;
  });
  const auto least_bent = kLeastBent * static_cast<double>(members.all.size());
  if (bent < kFewestBent || static_cast<double>(bent) < least_bent) return std::nullopt;
  const auto points = points_at(members.all);
  auto creased = CreasedPatch::fit(points, place, members.radius, roughness);
  if (!creased || creased->turn() <= rule_.least_turn) return std::nullopt;
  if (creased->gap() >= rule_.widest_gap * surroundings.spacing) return std::nullopt;
  const auto smooth = HeightPatch::fit(points, place, members.outward, members.radius, roughness);
  if (smooth && creased->misfit() + kLeastGain >= smooth->misfit()) return std::nullopt;
  const double rounding = rounding_of(*creased, surroundings.spacing);
  return SurfacePatch{place, middle_of(points), members.radius, std::move(*creased), members.all,
                      0.0,   rounding};
}

/// A crease that the nearer points of a thin part tell, if they all lie on one side of it: a field
/// in space would round it.
std::optional<SurfacePatch> PatchFitter::fit_creased_nearby(const Surroundings& surroundings,
                                                            const Eigen::Vector3d& place) const {
  if (!surroundings.exact || surroundings.nearest.size() <= nearer_points()) return std::nullopt;
  const auto nearest = surroundings.nearest.begin();
  if (is_thin({nearest, nearest + static_cast<std::ptrdiff_t>(nearer_points())}))
    return std::nullopt;
  const Members members = members_of(surroundings, place, surroundings.reach);
  if (members.all.size() <= nearer_points()) return std::nullopt;
  return fit_creased(surroundings, place, nearer_of(members, place), surroundings.roughness);
}

/// One smooth sheet over the points that face the same way.
std::optional<SurfacePatch> PatchFitter::fit_sheet(const Surroundings& surroundings,
                                                   const Eigen::Vector3d& place,
                                                   const Members& members, double roughness) const {
  const auto points = points_at(members.front);
  auto sheet = HeightPatch::fit(points, place, members.outward, members.front_radius, roughness,
                                surroundings.reach <= kCrowdedReach);
  if (!sheet) return std::nullopt;
  return SurfacePatch{
      place, middle_of(points), members.front_radius, std::move(*sheet), members.front, 0.0};
}

/// A patch of as many points, but of more lines and fewer points of each, where the points lie on
/// lines so far apart that few of these are among the nearest. As smooth a surface tells all the
/// more of a place by them; a rougher one would only have more bends in the patch, and nothing is
/// returned.
std::optional<SurfacePatch> PatchFitter::fit_across_lines(Surroundings surroundings,
                                                          const Eigen::Vector3d& place,
                                                          double roughness) const {
  std::vector<Eigen::Vector3d> arms;
  arms.reserve(surroundings.nearest.size());
  for (const auto& one : surroundings.nearest) arms.push_back(points_[one.index].position - place);
  const PointLines lines = lines_among(arms, surroundings.outward, surroundings.reach);
  if (lines.apart < kLinesApart * surroundings.spacing) return std::nullopt;
  // Half way, by the ratio of the distances, to a patch of as many lines as points of each.
  const double stretch = lines.apart / surroundings.spacing;
  const Eigen::Vector3d along = surroundings.outward.cross(lines.across);
  const auto count = static_cast<double>(surroundings.nearest.size());
  auto nearest = index_.nearest(place, static_cast<std::size_t>(stretch * count));
  for (auto& one : nearest) {
    const Eigen::Vector3d arm = points_[one.index].position - place;
    one.squared_distance += (1.0 / stretch - 1.0) * std::pow(lines.across.dot(arm), 2) +
                            (stretch - 1.0) * std::pow(along.dot(arm), 2);
  }
  std::sort(nearest.begin(), nearest.end(),
            [](const auto& a, const auto& b) { return a.squared_distance < b.squared_distance; });
  nearest.resize(std::min(nearest.size(), surroundings.nearest.size()));
  surroundings.nearest = std::move(nearest);
  const Members members = members_of(surroundings, place, surroundings.reach);
  auto patch = fit_sheet(surroundings, place, members, roughness);
  if (!patch || !std::get<HeightPatch>(patch->field).is_smooth()) return std::nullopt;
  return patch;
}

/// A polynomial, where the nearest of a crowd all lie on it: so there is neither a crease nor a
/// stray among them. Where the skin bends too much for those within the least reach, fewer do.
std::optional<SurfacePatch> PatchFitter::fit_plain(const Surroundings& surroundings,
                                                   const Eigen::Vector3d& place) const {
  if (!surroundings.exact || surroundings.reach > kCrowdedReach) return std::nullopt;
  const bool wider = kLeastReach > surroundings.reach;
  if (auto plain = plain_patch(wider ? index_.around(place, kLeastReach) : surroundings.nearest,
                               kLeastReach, surroundings.outward, place)) {
    return plain;
  }
  return plain_patch(surroundings.nearest, 0.0, surroundings.outward, place);
}

/// Of those within `reach`, at least of so many as a polynomial needs.
std::optional<SurfacePatch> PatchFitter::plain_patch(const Neighbours& found, double reach,
                                                     const Eigen::Vector3d& outward,
                                                     const Eigen::Vector3d& place) const {
  std::vector<std::size_t> members;
  double farthest = 0.0;  // its square
  for (const auto& [point, square] : found) {
    if (square > reach * reach && members.size() >= kFewestOfCrowd) break;
    if (points_[point].normal.dot(outward) < kFacing) continue;
    members.push_back(point);
    farthest = std::max(farthest, square);
  }
  const auto points = points_at(members);
  const double radius = std::sqrt(farthest);
  const auto field = QuinticPatch::fit(points, place, outward, radius);
  if (!field) return std::nullopt;
  const double variance = field->variance();
  return SurfacePatch{place, middle_of(points), radius, *field, std::move(members), variance};
}

std::optional<SurfacePatch> PatchFitter::fit(const Eigen::Vector3d& place) const {
  const Surroundings here = surroundings_of(place);
  if (is_thin(here.nearest)) {
    if (auto creased = fit_creased_nearby(here, place)) return creased;
    return fit_in_space(here, place);
  }
  if (auto plain = fit_plain(here, place)) return plain;
  const double narrowest = std::max(here.reach, kLeastReach);
  double width = std::min(kBandwidths * here.bandwidth(here.roughness), kWidest);
  for (int attempt = 1;; ++attempt) {
    const Members members = members_of(here, place, std::max(width, narrowest));
    // Noise hides a roughness whose bandwidth is wider than the patch.
    const double likely = std::max(here.roughness, here.noise_area / std::pow(members.radius, 5));
    const bool nearest_only = members.radius <= here.reach;
    if (here.exact && nearest_only && members.all.size() > nearer_points()) {
      if (auto creased = fit_creased(here, place, nearer_of(members, place), likely))
        return creased;
    }
    if (auto creased = fit_creased(here, place, members, likely)) return creased;
    const auto points = points_at(members.front);
    auto patch = fit_sheet(here, place, members, likely);
    if (!patch) {
      // Points on a line, such as one row of a scan, ask for more.
      width = kWidening * members.radius;
      if (attempt == kMostAttempts || width > kWidestHole) return std::nullopt;
      continue;
    }
    const auto& sheet = std::get<HeightPatch>(patch->field);
    if (!nearest_only && blurs(sheet, points, patch->radius)) {
      if (auto finer = fit_sheet(here, place, members_of(here, place, here.reach), likely))
        return finer;
    }
    if (sheet.is_smooth() && nearest_only && here.nearest.size() <= rule_.points) {
      if (auto across = fit_across_lines(here, place, likely)) return across;
    }
    const double fitting = kBandwidths * here.bandwidth(sheet.roughness());
    if (attempt == kMostAttempts || width <= narrowest || width <= kTooWide * fitting) return patch;
    width = fitting;
  }
}

}  // namespace instep
