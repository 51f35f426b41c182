#include "core/girth/slab_source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/geometry/piled_points.h"
#include "core/girth/thinned_lines.h"

namespace instep {
namespace {

/// The first slab that is asked for is to tell how wide the others have to be.
constexpr double kWiderThanFirst = 6.0;
constexpr double kWiderThanOthers = 1.2;

/// From the least to the most of what a cloud measures along a direction; taken of two points at a
/// time, which costs no more than of one.
class Reach {
 public:
  explicit Reach(const Eigen::Vector3d& along) : along_(along) {}

  void add(const Eigen::Array2d& x, const Eigen::Array2d& y, const Eigen::Array2d& z) {
    const Eigen::Array2d measures = along_.x() * x + along_.y() * y + along_.z() * z;
    least_ = measures.min(least_);
    most_ = measures.max(most_);
  }
  double length() const { return most_.maxCoeff() - least_.minCoeff(); }

 private:
  Eigen::Vector3d along_;
  Eigen::Array2d least_ = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d most_ = Eigen::Array2d::Constant(-std::numeric_limits<double>::infinity());
};

}  // namespace

SlabSource::SlabSource(const PointCloud& cloud, const TapePlane& plane,
                       std::optional<double> sigma_mm)
    : cloud_(cloud), plane_(plane), sigma_mm_(sigma_mm) {
  Reach along(plane.u());
  Reach across(plane.v());
  Reach above(plane.normal());
  const std::span<const Eigen::Vector3d> points(cloud.positions);
  for (std::size_t i = 0; i < points.size(); i += 2) {
    const Eigen::Vector3d& one = points[i];
    const Eigen::Vector3d& other = points[std::min(i + 1, points.size() - 1)];
    const Eigen::Array2d x(one.x(), other.x());
    const Eigen::Array2d y(one.y(), other.y());
    const Eigen::Array2d z(one.z(), other.z());
    along.add(x, y, z);
    across.add(x, y, z);
    above.add(x, y, z);
  }
  size_ = std::hypot(along.length(), across.length(), above.length());
}

PlaneSlab SlabSource::slab(double half_width) {
  if (half_width > half_width_) {
    half_width_ = (half_width_ < 0.0 ? kWiderThanFirst : kWiderThanOthers) * half_width;
    widest_ = slab_of(cloud_, plane_, half_width_);
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
