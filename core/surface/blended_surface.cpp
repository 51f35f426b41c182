#include "core/surface/blended_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace instep {
namespace {

/// Points of a patch: enough to fit a surface, few enough to solve quickly.
constexpr std::size_t kPatchPoints = 50;
/// Nearest points that tell which way is out.
constexpr std::size_t kFacingPoints = 8;
/// Cosine to that direction from which a point can be a height over the patch, and below which it
/// lies on the other side of a thin part.
constexpr double kFacing = 0.5;
constexpr double kBehind = -0.3;
/// Where there is noise, a patch is wider than the kriging's bandwidth by this factor, up to this
/// part of the body.
constexpr double kBandwidths = 2.5;
constexpr double kWidest = 0.15;
/// It is fitted again, narrower, if it turns out rougher than thought.
constexpr int kMostAttempts = 4;
constexpr double kTooWide = 1.5;
/// A crease turns at least this much (radians), and is so much likelier than one smooth sheet.
constexpr double kLeastTurn = 0.45;
constexpr double kLeastGain = 8.0;
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
    if ((place - patch.centre).norm() < kNearEnough * patch.radius) return true;
  }
  auto patch = fit(place);
  if (!patch) return false;
  patches_.push_back(std::move(*patch));
  return true;
}

/// Over which distance noise and roughness weigh the same.
double BlendedSurface::Surroundings::bandwidth(double of_roughness) const {
  return std::pow(noise_area / of_roughness, 0.2);
}

BlendedSurface::Surroundings BlendedSurface::surroundings_of(const Eigen::Vector3d& place) const {
  Surroundings here;
  here.nearest = index_.nearest(place, kPatchPoints);
  here.reach = std::sqrt(here.nearest.back().squared_distance);
  here.outward = Eigen::Vector3d::Zero();
  const std::size_t count = std::min(kFacingPoints, here.nearest.size());
  double variance = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    here.outward += points_[here.nearest[i].index].normal;
    variance += points_[here.nearest[i].index].variance / static_cast<double>(count);
  }
  here.outward.normalize();
  const auto found = static_cast<double>(here.nearest.size());
  here.noise_area = variance * std::numbers::pi * here.reach * here.reach / found;
  here.roughness = roughness_at(roughness_, place);
  return here;
}

BlendedSurface::Members BlendedSurface::members_of(const Surroundings& surroundings,
                                                   const Eigen::Vector3d& place,
                                                   double width) const {
  const bool wider = width > surroundings.reach;
  const auto found = wider ? index_.within(place, width) : surroundings.nearest;
  Members members;
  members.radius = std::sqrt(found.back().squared_distance);
  for (const auto& neighbour : found) {
    const OrientedPoint& point = points_[neighbour.index];
    const double cosine = point.normal.dot(surroundings.outward);
    if (cosine < kBehind) continue;
    members.all.push_back(point);
    if (cosine < kFacing) continue;
    members.front.push_back(point);
    members.outward += point.normal;
    members.front_radius = std::sqrt(neighbour.squared_distance);
  }
  members.outward.normalize();
  return members;
}

std::optional<BlendedSurface::Patch> BlendedSurface::fit(const Eigen::Vector3d& place) const {
  const Surroundings here = surroundings_of(place);
  double width = std::min(kBandwidths * here.bandwidth(here.roughness), kWidest);
  for (int attempt = 1;; ++attempt) {
    const Members members = members_of(here, place, width);
    // Noise hides a roughness whose bandwidth is wider than the patch.
    const double likely = std::max(here.roughness, here.noise_area / std::pow(members.radius, 5));
    auto creased = CreasedPatch::fit(members.all, place, members.radius, likely);
    if (creased && creased->turn() > kLeastTurn) {
      const auto smooth =
          HeightPatch::fit(members.all, place, members.outward, members.radius, likely);
      if (!smooth || creased->misfit() + kLeastGain < smooth->misfit()) {
        return Patch{place, members.radius, std::move(*creased)};
      }
    }
    auto smooth =
        HeightPatch::fit(members.front, place, members.outward, members.front_radius, likely);
    if (!smooth) return std::nullopt;
    const double fitting = kBandwidths * here.bandwidth(smooth->roughness());
    if (attempt == kMostAttempts || width <= here.reach || width <= kTooWide * fitting) {
      return Patch{place, members.front_radius, std::move(*smooth)};
    }
    width = fitting;
  }
}

FieldValue BlendedSurface::Patch::at(const Eigen::Vector3d& place) const {
  return std::visit([&](const auto& surface) { return surface.at(place); }, field);
}

std::optional<FieldValue> BlendedSurface::at(const Eigen::Vector3d& place) const {
  double weights = 0.0;
  Eigen::Vector3d weights_gradient = Eigen::Vector3d::Zero();
  FieldValue sum;
  for (const auto& patch : patches_) {
    const Weight weight = wendland(place - patch.centre, kReach * patch.radius);
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
