#include "core/surface/patches/patch_fitter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/mean.h"
#include "core/picked.h"
#include "core/stride.h"
#include "core/surface/patches/crease_rule.h"
#include "core/surface/patches/open_patch.h"
#include "core/surface/patches/stray_free_sheet.h"
#include "core/surface/point_lines.h"

namespace instep {
namespace {

/// Lines further apart than so many spacings are told from a chance gap.
constexpr double kLinesApart = 1.5;
/// A crease further from the points of a side than this part of what lies between two lines. Of
/// exact rows 10 to 20 mm apart along round bodies girths were 1 to 15 mm too long, and are 0.01 to
/// 0.9 off; at six tenths single ones are still 0.9 too long. The lattice of a last's vertices pays
/// with 0.03 mm.
constexpr double kBesideLines = 0.4;
/// How far a patch in space may be off: the variance half-way between points, against roughness
/// times the cube of their spacing, and how many points share in averaging noise.
constexpr double kWanderingInSpace = 0.1;
constexpr int kAveragedInSpace = 6;
/// A patch is at least this part of the body wide; of noisy points that are bent as round an edge,
/// which their averages would blunt, only as wide as the nearest ones lie. Girths of bodies with an
/// edge, 60,000 and 200,000 points with 0.02 to 0.1 mm of noise, were 0.08 to 0.09 mm short, and
/// are 0.01 to 0.05.
constexpr double kLeastReach = 0.033;
/// Neighbours that reach no further are a crowd: of exact ones a polynomial may tell all. It is
/// made of those within the least reach, or of so many.
constexpr double kCrowdedReach = 0.04;
constexpr std::size_t kFewestOfCrowd = 44;
/// The shape between the estimates of roughness may be rougher than they are.
constexpr double kAllowanceInSpace = 4.0;
/// And so many times as rough, twice at most, where, as at a tip between flat sides, the field
/// lies further off the nearest third of its points than their noise explains (mean square): still
/// rougher it goes out to a wall beside the body.
constexpr double kRougherInSpace = 10.0;
constexpr int kMostAgain = 2;
constexpr std::size_t kNearestPart = 3;
constexpr double kMissed = 2.0;
/// Where there is noise, a patch is wider than the kriging's bandwidth by this factor, up to this
/// part of the body.
constexpr double kBandwidths = 2.0;
constexpr double kWidest = 0.10;
/// It is fitted again, narrower, if it turns out rougher than thought.
constexpr int kMostAttempts = 5;
constexpr double kTooWide = 1.5;
/// Or wider, if the points determine no surface yet.
constexpr double kWidening = 1.6;
/// Of many exact points: how far off their averages' surface they lie where these blur what the
/// points tell, root mean square against the radius. On scanned feet of 200,000 points girths were
/// 0.10 mm short, and are 0.07 with patches of the nearest ones there.
constexpr double kBlurred = 1e-3;
/// One in so many of the nearest is left out to see whether the others tell where it lies. Without
/// it a noisy twentieth of an exact crowd of 150,000 made contact lengths 2 to 10 mm too long, not
/// 0.1 to 0.6.
constexpr std::size_t kAskedOneIn = 6;
/// The most that the others may be off there, squared, against the averages, which know it.
constexpr double kFiner = 1.2;
/// An edge may be round where no points lie: part of what a length over it would lose by that.
constexpr double kRounding = 0.15;
/// Of exact points the gain (twice the logarithm of a likelihood, for each point) tells more: of
/// 2,000 points of a box of sharp edges it is 12 to 18, where these are round by a quarter of the
/// spacing 4 to 14, by half of it 2 to 11 and by all of it 1 to 3. Edges of lasts, whose sheets
/// bend, show 3 to 9. The part is as much over it, within limits.
constexpr double kRoundingOverGain = 0.8;
constexpr double kLeastRounding = 0.05;
constexpr double kMostRounding = 0.5;
/// The sides of a thin part that bend on the way to their edge by more than this part of the angle
/// that they meet in go on to bend there: the tip is round. With twice as much, girths of thin
/// ellipses err 1.1 mm, not 0.9, and 69 % hold, not 85; with less than half of it, edges of lenses
/// are taken for round.
constexpr double kMostBentTip = 0.25;
/// Sides that turn more (radians) run beside each other, as those of a plate: where they seem to
/// meet is chance.
constexpr double kHardlyATip = 2.95;
/// Noise of more than this part of the spacing hides how sharp an edge is.
constexpr double kHidesSharpness = 2e-4;

Eigen::Vector3d middle_of(const std::vector<OrientedPoint>& points) {
  return mean_of(points, &OrientedPoint::position);
}

/// By how much a length over an edge would be shorter if the edge were as round as its gaps allow,
/// an arc that meets both sheets at their last points, times `part`, and how likely that is: where
/// they come as near as their spacing lets them, it is sharp.
double rounding_of(const CreasedPatch& creased, double spacing, double part) {
  const double half = 0.5 * creased.turn();
  const double lost = 2.0 * creased.gap() * (1.0 - half / std::tan(half));
  return part * std::min(creased.gap() / spacing, 1.0) * lost;
}

/// `gain`: for each point.
double rounding_by_gain(double gain) {
  return std::clamp(kRoundingOverGain / gain, kLeastRounding, kMostRounding);
}

/// Whether a crease lies where it meets no point but those of whole lines beside it: a few lines
/// along a round body look like the edges of a prism.
bool runs_between_lines(const CreasedPatch& creased, const std::vector<OrientedPoint>& points,
                        const Eigen::Vector3d& place, const PatchPoints::Members& members,
                        double spacing) {
  std::vector<Eigen::Vector3d> arms;
  arms.reserve(points.size());
  for (const auto& point : points) arms.push_back(point.position - place);
  const double apart = lines_among(arms, members.outward, members.radius).apart;
  return apart > kLinesApart * spacing && creased.gap() > kBesideLines * apart;
}

/// Sum of the squares.
double off_by(const HeightPatch& sheet, const std::vector<OrientedPoint>& points) {
  double squares = 0.0;
  for (const auto& point : points) squares += std::pow(sheet.at(point.position).value, 2);
  return squares;
}

/// Whether a surface through averages of exact points leaves out detail that these tell.
bool blurs(const HeightPatch& sheet, const std::vector<OrientedPoint>& points, double radius) {
  if (!sheet.is_exact() || points.size() <= kMostHeightSamples) return false;
  const double most = kBlurred * radius;
  return off_by(sheet, points) > most * most * static_cast<double>(points.size());
}

/// Whether a field lies further off the nearest of its noisy points, which come first, than their
/// noise explains.
bool misses(const HermitePatch& field, const std::vector<OrientedPoint>& points) {
  const std::size_t count = points.size() / kNearestPart;
  double squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(points[i].variance > 0.0)) return false;
    squares += std::pow(field.at(points[i].position).value, 2) / points[i].variance;
  }
  return squares > kMissed * static_cast<double>(count);
}

}  // namespace

PatchFitter::PatchFitter(std::vector<OrientedPoint> points, PointIndex index,
                         std::vector<LocalRoughness> roughness)
    : points_(std::move(points), std::move(index), std::move(roughness)) {}

std::optional<SurfacePatch> PatchFitter::fit_in_space(const Surroundings& surroundings,
                                                      const Eigen::Vector3d& place) const {
  const std::size_t most = points_.rule().points_in_space;
  const bool wider = surroundings.nearest.size() > most;
  const auto nearest = wider ? surroundings.nearest : points_.index().nearest(place, most);
  // Of many, an even sample by their distance.
  const std::size_t stride = stride_to_at_most(most, nearest.size());
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < nearest.size(); i += stride) members.push_back(nearest[i].index);
  points_.drop_twins(members, surroundings.spacing);
  const double radius = std::sqrt(nearest.back().squared_distance);
  auto points = points_.at(members);
  // What little looks like noise is shape: where a flat side is the smoothest part of all,
  // smoothing by it would leave the other side's bends out, and put this side off its points.
  for (auto& point : points) {
    if (is_harmless(point, surroundings.spacing)) point.variance = 0.0;
  }
  double roughness = kAllowanceInSpace * surroundings.roughness;
  auto field = HermitePatch::fit(points, place, radius, roughness);
  for (int again = 0; field && misses(*field, points) && again < kMostAgain; ++again) {
    roughness *= kRougherInSpace;
    field = HermitePatch::fit(points, place, radius, roughness);
  }
  if (!field) return std::nullopt;
  const double noise = surroundings.noise_area / (surroundings.spacing * surroundings.spacing);
  const double variance =
      kWanderingInSpace * roughness / kAllowanceInSpace * std::pow(surroundings.spacing, 3) +
      noise / static_cast<double>(kAveragedInSpace);
  return SurfacePatch{place, place, radius, std::move(*field), std::move(members), variance};
}

/// Where the points tell a crease better than one smooth sheet.
std::optional<SurfacePatch> PatchFitter::fit_creased(const Surroundings& surroundings,
                                                     const Eigen::Vector3d& place,
                                                     const Members& members,
                                                     double roughness) const {
  if (!points_.are_bent(members)) return std::nullopt;
  const auto points = points_.at(members.all);
  const bool clear = points_.are_clear(surroundings);
  const CreaseRule& rule = points_.crease_rule(clear);
  auto creased = CreasedPatch::fit(points, place, members.radius, roughness, clear);
  if (!creased || creased->turn() <= rule.least_turn) return std::nullopt;
  if (creased->gap() >= rule.widest_gap * surroundings.spacing) return std::nullopt;
  if (runs_between_lines(*creased, points, place, members, surroundings.spacing))
    return std::nullopt;
  const auto smooth = HeightPatch::fit(points, place, members.outward, members.radius, roughness);
  double part = kRounding;
  if (smooth) {
    const double gain = smooth->misfit() - creased->misfit();
    if (gain <= rule.gain_asked(creased->turn())) return std::nullopt;
    const double noise = std::sqrt(surroundings.noise_area) / surroundings.spacing;
    if (noise < kHidesSharpness * surroundings.spacing) {
      part = rounding_by_gain(gain / static_cast<double>(points.size()));
    }
  }
  const double rounding = rounding_of(*creased, surroundings.spacing, part);
  return SurfacePatch{place, middle_of(points), members.radius, std::move(*creased), members.all,
                      0.0,   rounding};
}

/// A crease that the nearer points of a thin part tell, if they all lie on one side of it: a field
/// in space would round it.
std::optional<SurfacePatch> PatchFitter::fit_creased_nearby(const Surroundings& surroundings,
                                                            const Eigen::Vector3d& place) const {
  if (!surroundings.exact || surroundings.nearest.size() <= points_.nearer_points())
    return std::nullopt;
  const auto nearest = surroundings.nearest.begin();
  if (points_.is_thin({nearest, nearest + static_cast<std::ptrdiff_t>(points_.nearer_points())}))
    return std::nullopt;
  const Members members = points_.members_of(surroundings, place, surroundings.reach);
  if (members.all.size() <= points_.nearer_points()) return std::nullopt;
  return fit_creased(surroundings, place, points_.nearer_of(members, place),
                     surroundings.roughness);
}

/// The acute edge that both sides of a thin part run to: a field in space would round it.
std::optional<SurfacePatch> PatchFitter::fit_acute(const Surroundings& surroundings,
                                                   const Eigen::Vector3d& place) const {
  const Members members = points_.all_round(surroundings);
  Surroundings here = surroundings;
  // Only half of the points that were taken for those of one sheet lie on either.
  here.spacing *= std::numbers::sqrt2;
  here.noise_area *= 2.0;
  std::optional<SurfacePatch> patch;
  if (here.exact && members.all.size() > points_.nearer_points()) {
    patch = fit_creased(here, place, points_.nearer_of(members, place), here.roughness);
  }
  if (!patch) patch = fit_creased(here, place, members, here.roughness);
  if (!patch) return patch;
  const auto& creased = std::get<CreasedPatch>(patch->field);
  const double bend = creased.bend() / creased.turn();
  if (creased.turn() > kHardlyATip || bend > kMostBentTip) return std::nullopt;
  patch->rounding = rounding_of(creased, here.spacing, kRounding + std::max(bend, 0.0));
  return patch;
}

/// One smooth sheet over the points that face the same way, but those that are strays.
std::optional<SurfacePatch> PatchFitter::fit_sheet(const Surroundings& surroundings,
                                                   const Eigen::Vector3d& place,
                                                   const Members& members, double roughness) const {
  const auto front = points_.at(members.front);
  const auto fit_to = [&](const std::vector<OrientedPoint>& points) {
    return HeightPatch::fit(points, place, members.outward, members.front_radius, roughness,
                            surroundings.reach <= kCrowdedReach);
  };
  auto sheet = StrayFreeSheet::of(front, fit_to);
  if (!sheet) return std::nullopt;
  auto numbers = picked(members.front, sheet->numbers);
  const Eigen::Vector3d middle = middle_of(points_.at(numbers));
  SurfacePatch patch{place, middle, members.front_radius, std::move(sheet->patch),
                     std::move(numbers)};
  patch.has_strays = patch.members.size() < members.front.size();
  return patch;
}

/// A patch of the nearest points, if most of them tell about as well where the others lie as the
/// sheet through averages, which knows these: of detail they do, of noise they do not.
std::optional<SurfacePatch> PatchFitter::fit_finer(const Surroundings& surroundings,
                                                   const Eigen::Vector3d& place,
                                                   const HeightPatch& blurred,
                                                   double roughness) const {
  const Members members = points_.members_of(surroundings, place, surroundings.reach);
  std::vector<OrientedPoint> asked;
  std::vector<OrientedPoint> others;
  for (std::size_t i = 0; i < members.front.size(); ++i) {
    (i % kAskedOneIn == 0 ? asked : others).push_back(points_.all()[members.front[i]]);
  }
  const auto most = HeightPatch::fit(others, place, members.outward, members.front_radius,
                                     roughness, surroundings.reach <= kCrowdedReach);
  if (!most || !(off_by(*most, asked) < kFiner * off_by(blurred, asked))) return std::nullopt;
  return fit_sheet(surroundings, place, members, roughness);
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
  for (const auto& one : surroundings.nearest)
    arms.push_back(points_.all()[one.index].position - place);
  const PointLines lines = lines_among(arms, surroundings.outward, surroundings.reach);
  if (lines.apart < kLinesApart * surroundings.spacing) return std::nullopt;
  // Half way, by the ratio of the distances, to a patch of as many lines as points of each.
  const double stretch = lines.apart / surroundings.spacing;
  const Eigen::Vector3d along = surroundings.outward.cross(lines.across);
  const auto count = static_cast<double>(surroundings.nearest.size());
  auto nearest = points_.index().nearest(place, static_cast<std::size_t>(stretch * count));
  for (auto& one : nearest) {
    const Eigen::Vector3d arm = points_.all()[one.index].position - place;
    one.squared_distance += (1.0 / stretch - 1.0) * std::pow(lines.across.dot(arm), 2) +
                            (stretch - 1.0) * std::pow(along.dot(arm), 2);
  }
  std::sort(nearest.begin(), nearest.end(),
            [](const auto& a, const auto& b) { return a.squared_distance < b.squared_distance; });
  nearest.resize(std::min(nearest.size(), surroundings.nearest.size()));
  surroundings.nearest = std::move(nearest);
  const Members members = points_.members_of(surroundings, place, surroundings.reach);
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
  if (auto plain =
          plain_patch(wider ? points_.index().around(place, kLeastReach) : surroundings.nearest,
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
    if (!points_.faces(point, outward)) continue;
    members.push_back(point);
    farthest = std::max(farthest, square);
  }
  const auto points = points_.at(members);
  const double radius = std::sqrt(farthest);
  const auto field = QuinticPatch::fit(points, place, outward, radius);
  if (!field) return std::nullopt;
  const double variance = field->variance();
  return SurfacePatch{place, middle_of(points), radius, *field, std::move(members), variance};
}

double PatchFitter::narrowest_at(const Eigen::Vector3d& place, const Surroundings& here) const {
  if (here.reach >= kLeastReach) return here.reach;
  const bool edge = !here.exact && points_.are_bent(points_.members_of(here, place, kLeastReach));
  return edge ? here.reach : kLeastReach;
}

std::optional<SurfacePatch> PatchFitter::fit(const Eigen::Vector3d& place) const {
  const Surroundings here = points_.surroundings_of(place);
  if (points_.is_thin(here.nearest)) {
    if (auto creased = fit_creased_nearby(here, place)) return creased;
    if (auto creased = fit_acute(here, place)) return creased;
    return fit_in_space(here, place);
  }
  if (auto plain = fit_plain(here, place)) return plain;
  double narrowest = narrowest_at(place, here);
  double width = std::min(kBandwidths * here.bandwidth(here.roughness), kWidest);
  double shown = 0.0;  // of roughness, by the patch before, which was wider: it tells it better
  for (int attempt = 1;; ++attempt) {
    const Members members = points_.members_of(here, place, std::max(width, narrowest));
    // Noise hides a roughness whose bandwidth is wider than the patch.
    const double likely =
        std::max({here.roughness, here.noise_area / std::pow(members.radius, 5), shown});
    const bool nearest_only = members.radius <= here.reach;
    if (here.exact && nearest_only && members.all.size() > points_.nearer_points()) {
      if (auto creased = fit_creased(here, place, points_.nearer_of(members, place), likely))
        return creased;
    }
    if (auto creased = fit_creased(here, place, members, likely)) return creased;
    auto patch = fit_sheet(here, place, members, likely);
    if (!patch) {
      // Points on a line, such as one row of a scan, ask for more.
      width = kWidening * members.radius;
      if (attempt == kMostAttempts || width > PatchPoints::kWidestHole) return std::nullopt;
      continue;
    }
    const double nearest = std::sqrt(here.nearest.front().squared_distance);
    const double wider = kWidening * members.radius;
    if (attempt < kMostAttempts && wider <= PatchPoints::kWidestHole &&
        is_open(*patch, nearest, points_.all())) {
      width = narrowest = wider;
      continue;
    }
    const auto& sheet = std::get<HeightPatch>(patch->field);
    // Of all points: what was left out may be detail that averages hide.
    if (!nearest_only && blurs(sheet, points_.at(members.front), patch->radius)) {
      if (auto finer = fit_finer(here, place, sheet, likely)) return finer;
    }
    if (sheet.is_smooth() && nearest_only && here.nearest.size() <= points_.rule().points) {
      if (auto across = fit_across_lines(here, place, likely)) return across;
    }
    const double fitting = kBandwidths * here.bandwidth(sheet.roughness());
    if (attempt == kMostAttempts || width <= narrowest || width <= kTooWide * fitting) return patch;
    width = fitting;
    shown = sheet.roughness();
  }
}

}  // namespace instep
