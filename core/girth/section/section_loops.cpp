#include "core/girth/section/section_loops.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>

#include "core/geometry/polygon.h"
#include "core/girth/contour/contour_trace.h"
#include "core/girth/contour/section_gaps.h"
#include "core/mean.h"

namespace instep {
namespace {

/// Steps in grains: short ones place the patches evenly, longer ones read the finished field. Of a
/// thinned crowd patches reach as far in any case.
constexpr double kDraftStep = 0.4;
constexpr double kDraftStepInThinned = 0.8;
constexpr double kReadingStep = 0.6;
/// Loops of two bodies, or of both sides of a thin part, are further apart than this.
constexpr double kSameInGrains = 0.3;
/// Of a section, against the width of the body.
constexpr double kLongestSection = 6.0;
/// Points along a loop, against those along the best founded one.
constexpr double kLeastFounded = 0.25;
/// Of a loop, on which it runs along another of the same body, and how long it is against that at
/// least. Of 320 girths with strays on one side 7 are over two intervals off, and 10 with both.
constexpr double kOneBody = 0.5;
/// Of what points enclose, against the square of its outline: ten times as long as it is wide, a
/// noisy wall.
constexpr double kLeastWide = 0.02;
constexpr int kMostLoops = 8;
constexpr int kMostStarts = 40;
/// One in so many points, the nearest to the plane, is a start at least.
constexpr std::size_t kStartShare = 30;

/// The points nearest to the plane: the outermost one, then in an order that spreads over all of
/// them. Most lie on the largest body, so a lump beside it does not use up the starts.
std::vector<std::size_t> starts_of(const PlaneBand& band) {
  std::vector<double> heights;
  for (const auto& point : band.points) heights.push_back(std::abs(point.position.z()));
  std::vector<double> order = heights;
  const auto share = order.begin() + static_cast<std::ptrdiff_t>(order.size() / kStartShare);
  std::nth_element(order.begin(), share, order.end());
  const double near = std::max(band.spacing, *share);
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (heights[i] <= near) candidates.push_back(i);
  }
  std::vector<std::size_t> starts = {candidates.front()};
  const std::size_t count = candidates.size();
  for (std::size_t stride = std::size_t{1} << 20; stride > 0; stride /= 2) {
    for (std::size_t i = stride; i <= count; i += 2 * stride) starts.push_back(candidates[i - 1]);
  }
  return starts;
}

/// Whether one of the loops passes within a distance of a place.
bool pass_near(const std::vector<SectionLoop>& loops, const Eigen::Vector2d& place,
               double distance) {
  return std::any_of(loops.begin(), loops.end(), [&](const SectionLoop& loop) {
    return loop.index.foot_of(place).distance < distance;
  });
}

/// Follows every loop that starts near a point on the plane and round which the body lies inside.
std::vector<SectionLoop> trace_all(const PlaneBand& band, BlendedSurface& surface) {
  std::vector<SectionLoop> loops;
  const double draft_step = band.thinned_out > 0 ? kDraftStepInThinned : kDraftStep;
  int starts = 0;
  for (const std::size_t candidate : starts_of(band)) {
    const Eigen::Vector2d start = band.points[candidate].position.head<2>();
    if (pass_near(loops, start, evidence_reach(band))) continue;
    if (++starts > kMostStarts || loops.size() >= kMostLoops) break;
    // The first round places the patches, the second reads the finished field.
    const auto draft =
        trace_contour(surface, start, draft_step * band.grain, kWidestBridge, kLongestSection);
    // Where the plane cuts the skin at a slant, points beside a known loop lead to it too.
    if (!draft || pass_near(loops, draft->points.front(), kSameInGrains * band.grain)) continue;
    auto contour = trace_contour(surface, draft->points.front(), kReadingStep * band.grain,
                                 kWidestBridge, kLongestSection);
    if (contour && contour->goes_round_once()) loops.emplace_back(std::move(*contour));
  }
  return loops;
}

/// Points that make each of the loops, for its length.
std::vector<double> densities_of(const PlaneBand& band, const std::vector<SectionLoop>& loops) {
  std::vector<double> densities;
  for (const auto& loop : loops) {
    const auto evidence = evidence_for(band, loop.index, evidence_reach(band));
    densities.push_back(static_cast<double>(evidence.along) / loop.index.length());
  }
  return densities;
}

/// The part of a loop that is another one's too.
double part_along(const SectionLoop& loop, const SectionLoop& other, double same) {
  const auto& corners = loop.contour.points;
  const auto shared = std::count_if(corners.begin(), corners.end(), [&](const auto& corner) {
    return other.index.passes_within(same, corner);
  });
  return static_cast<double>(shared) / static_cast<double>(corners.size());
}

/// Whether two loops are readings of one body: half of the shorter one is the other's, and that no
/// far longer.
bool run_together(const SectionLoop& one, const SectionLoop& other, double same) {
  const bool is_shorter = one.index.length() < other.index.length();
  const auto& [shorter, longer] = is_shorter ? std::tie(one, other) : std::tie(other, one);
  return shorter.index.length() > kOneBody * longer.index.length() &&
         part_along(shorter, longer, same) >= kOneBody;
}

/// Of two that run together the better founded one stays, and none that is far worse than the best.
void drop_unfounded(const PlaneBand& band, std::vector<SectionLoop>& loops) {
  if (loops.size() < 2) return;
  const auto densities = densities_of(band, loops);
  std::vector<std::size_t> order(loops.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return densities[a] > densities[b]; });
  const double same = kSameInGrains * band.grain;
  std::vector<SectionLoop> founded;
  for (const std::size_t i : order) {
    if (densities[i] < kLeastFounded * densities[order.front()]) break;
    const bool is_other = std::none_of(founded.begin(), founded.end(), [&](const auto& better) {
      return run_together(loops[i], better, same);
    });
    if (is_other) founded.push_back(std::move(loops[i]));
  }
  loops = std::move(founded);
}

/// The loop round the largest area first.
void largest_first(std::vector<SectionLoop>& loops) {
  std::stable_sort(loops.begin(), loops.end(), [](const SectionLoop& a, const SectionLoop& b) {
    return signed_area(a.contour.points) > signed_area(b.contour.points);
  });
}

/// Of the points near the plane that lie on no loop.
std::vector<Eigen::Vector2d> unexplained_places(const PlaneBand& band,
                                                const std::vector<SectionLoop>& loops) {
  const double near = evidence_reach(band);
  std::vector<Eigen::Vector2d> places;
  for (const auto& point : band.points) {
    if (std::abs(point.position.z()) > near) continue;
    const bool is_on_one = std::any_of(loops.begin(), loops.end(), [&](const SectionLoop& loop) {
      return may_run_to(loop.index, point, near);
    });
    if (!is_on_one) places.emplace_back(point.position.head<2>());
  }
  return places;
}

}  // namespace

std::vector<SectionLoop> loops_on(const PlaneBand& band, BlendedSurface& surface) {
  auto loops = trace_all(band, surface);
  drop_unfounded(band, loops);
  largest_first(loops);
  return loops;
}

double unexplained_share(const PlaneBand& band, const std::vector<SectionLoop>& loops,
                         const SectionEvidence& of_first) {
  const auto unexplained = static_cast<double>(
      loops.size() > 1 ? unexplained_places(band, loops).size() : of_first.beside);
  return unexplained / static_cast<double>(of_first.beside + of_first.along);
}

bool has_larger_beside(const PlaneBand& band, const std::vector<SectionLoop>& loops) {
  auto outline = convex_hull(unexplained_places(band, loops));
  const auto& section = loops.front().contour.points;
  const double area = signed_area(outline);
  const double length = perimeter(outline);
  if (!(area > kLeastWide * length * length && area > signed_area(section))) return false;
  outline.push_back(mean_of(section));
  return signed_area(convex_hull(std::move(outline))) > area;
}

}  // namespace instep
