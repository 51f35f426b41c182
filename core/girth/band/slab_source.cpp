#include "core/girth/band/slab_source.h"

#include <algorithm>
#include <utility>

#include "core/geometry/piles/piled_points.h"
#include "core/girth/band/thinned_lines.h"

namespace instep {
namespace {

/// The first slab that is asked for is to tell how wide the others have to be.
constexpr double kWiderThanFirst = 6.0;
constexpr double kWiderThanOthers = 1.2;

}  // namespace

SlabSource::SlabSource(const PointCloud& cloud, const TapePlane& plane,
                       std::optional<double> sigma_mm)
    : cloud_(cloud), plane_(plane), sigma_mm_(sigma_mm), heights_(cloud, plane) {}

PlaneSlab SlabSource::slab(double half_width) {
  if (half_width > half_width_) {
    half_width_ = (half_width_ < 0.0 ? kWiderThanFirst : kWiderThanOthers) * half_width;
    widest_ = slab_of(cloud_, plane_, half_width_, heights_);
    if (level_) level_widest();
    if (apart_) thin_widest();
  }
  return within(widest_, half_width);
}

void SlabSource::thin_lines(double apart) {
  apart_ = apart;
  thin_widest();
}

void SlabSource::level_piles(double least_side, double half_width) {
  if (apart_ || level_) return;
  const double step = rounding_step(plane_);
  const auto places = in_steps(slab(half_width).places, step);
  // Of a body hardly larger than the rounding, cells are no smaller than a step.
  const double side = std::max(std::round(least_side / step), 1.0);
  level_ = level_beside_piles(places, 2.0 * half_width / step, side);
  if (level_) level_widest();
}

void SlabSource::level_widest() {
  const double step = rounding_step(plane_);
  auto rest = levelled(in_steps(widest_.places, step), *level_, told_noise(widest_));
  for (double& error : rest.errors) error *= step;
  widest_.errors_mm = std::move(rest.errors);
  widest_ = without(rest.surplus, widest_);
}

/// Of each place, the most of those that nobody saw; none if nothing is told that counts.
std::vector<double> SlabSource::told_noise(const PlaneSlab& slab) const {
  if (sigma_mm_ || !cloud_.has_sigma()) return {};
  std::vector<double> sigmas;
  sigmas.reserve(slab.indices.size());
  for (const std::size_t i : slab.indices) {
    sigmas.push_back(cloud_.was_seen(i) ? cloud_.sigma_mm[i] : std::numeric_limits<double>::max());
  }
  return sigmas;
}

void SlabSource::thin_widest() {
  ThinnedLines thinned = thinned_lines(cloud_, widest_, *apart_, !sigma_mm_);
  widest_ = std::move(thinned.slab);
  stray_share_ = thinned.stray_share;
}

}  // namespace instep
