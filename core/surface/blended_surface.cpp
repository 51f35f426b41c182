#include "core/surface/blended_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace instep {
namespace {

/// Points of a patch: enough to average noise over a neighbourhood, few enough to solve quickly.
constexpr std::size_t kPatchPoints = 80;
/// A patch counts up to this part of its radius, beyond which it has no points on all sides.
constexpr double kReach = 0.75;
/// A place needs a patch centred within this part of the patch's radius.
constexpr double kNearEnough = 0.35;

struct Weight {
  double value = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

/// Wendland's C2 function of compact support.
Weight wendland(const Eigen::Vector3d& offset, double reach) {
  const double q = offset.norm() / reach;
  if (q >= 1.0) return {};
  const double rest = 1.0 - q;
  return {rest * rest * rest * rest * (4.0 * q + 1.0),
          -20.0 * rest * rest * rest / (reach * reach) * offset};
}

std::vector<Eigen::Vector3d> positions_of(const std::vector<OrientedPoint>& points) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(points.size());
  for (const auto& point : points) positions.push_back(point.position);
  return positions;
}

}  // namespace

BlendedSurface::BlendedSurface(std::vector<OrientedPoint> points,
                               std::vector<LocalRoughness> roughness)
    : points_(std::move(points)),
      positions_(positions_of(points_)),
      index_(positions_),
      roughness_(std::move(roughness)) {}

bool BlendedSurface::visit(const Eigen::Vector3d& place) {
  for (const auto& patch : patches_) {
    if ((place - patch.centre()).norm() < kNearEnough * patch.radius()) return true;
  }
  const auto nearest = index_.nearest(place, kPatchPoints);
  std::vector<OrientedPoint> members;
  members.reserve(nearest.size());
  for (const auto& neighbour : nearest) members.push_back(points_[neighbour.index]);
  const double radius = std::sqrt(nearest.back().squared_distance);
  auto patch = HermitePatch::fit(members, place, radius, roughness_at(roughness_, place));
  if (!patch) return false;
  patches_.push_back(std::move(*patch));
  return true;
}

std::optional<FieldValue> BlendedSurface::at(const Eigen::Vector3d& place) const {
  double weights = 0.0;
  Eigen::Vector3d weights_gradient = Eigen::Vector3d::Zero();
  FieldValue sum;
  for (const auto& patch : patches_) {
    const Weight weight = wendland(place - patch.centre(), kReach * patch.radius());
    if (weight.value <= 0.0) continue;
    const FieldValue field = patch.at(place);
    weights += weight.value;
    weights_gradient += weight.gradient;
    sum.value += weight.value * field.value;
    sum.gradient += weight.value * field.gradient + field.value * weight.gradient;
  }
  if (weights <= 0.0) return std::nullopt;
  const double value = sum.value / weights;
  return FieldValue{value, (sum.gradient - value * weights_gradient) / weights};
}

double BlendedSurface::distance_to_data(const Eigen::Vector3d& place) const {
  return std::sqrt(index_.nearest(place, 1).front().squared_distance);
}

}  // namespace instep
