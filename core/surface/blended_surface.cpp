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
  std::vector<std::size_t> indices;
  for (const auto& neighbour : nearest) {
    members.push_back(points_[neighbour.index]);
    indices.push_back(neighbour.index);
  }
  const double radius = std::sqrt(nearest.back().squared_distance);
  auto patch = HermitePatch::fit(members, place, radius, roughness_at(roughness_, place));
  if (!patch) return false;
  patches_.push_back(std::move(*patch));
  members_.push_back(std::move(indices));
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

double BlendedSurface::deviation_of(const std::vector<Eigen::Vector3d>& places,
                                    const std::vector<double>& weights) const {
  std::vector<double> totals;
  for (const auto& place : places) {
    double total = 0.0;
    for (const auto& patch : patches_) {
      total += wendland(place - patch.centre(), kReach * patch.radius()).value;
    }
    totals.push_back(total);
  }
  std::vector<double> influence(points_.size(), 0.0);
  std::vector<double> unknown(patches_.size(), 0.0);
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const HermitePatch& patch = patches_[p];
    std::vector<Eigen::Vector3d> own_places;
    std::vector<double> own_weights;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double share =
          wendland(places[k] - patch.centre(), kReach * patch.radius()).value / totals[k];
      if (!(share > 0.0) || weights[k] == 0.0) continue;
      own_places.push_back(places[k]);
      own_weights.push_back(share * weights[k]);
    }
    if (own_places.empty()) continue;
    const FieldReading reading = patch.read(
        own_places, Eigen::Map<const Eigen::VectorXd>(
                        own_weights.data(), static_cast<Eigen::Index>(own_weights.size())));
    double noise = 0.0;
    for (std::size_t i = 0; i < members_[p].size(); ++i) {
      const double weight = reading.point_weights[static_cast<Eigen::Index>(i)];
      influence[members_[p][i]] += weight;
      noise += weight * weight * points_[members_[p][i]].variance;
    }
    unknown[p] = std::sqrt(std::max(reading.variance - noise, 0.0));
  }
  double variance = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    variance += influence[i] * influence[i] * points_[i].variance;
  }
  // Patches that share points err alike; the share falls with the distance of their centres.
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    for (std::size_t q = 0; q < patches_.size(); ++q) {
      const double distance = (patches_[p].centre() - patches_[q].centre()).norm();
      const double shared = 1.0 - distance / std::min(patches_[p].radius(), patches_[q].radius());
      variance += std::max(shared, 0.0) * unknown[p] * unknown[q];
    }
  }
  return std::sqrt(variance);
}

double BlendedSurface::distance_to_data(const Eigen::Vector3d& place) const {
  return std::sqrt(index_.nearest(place, 1).front().squared_distance);
}

}  // namespace instep
