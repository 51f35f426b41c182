#include "core/surface/blended_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace instep {
namespace {

/// A patch counts up to this part of its radius round the middle of its points, beyond which it has
/// none on all sides.
constexpr double kReach = 0.75;
/// A place needs a patch centred within this part of the patch's radius; at creases and thin parts,
/// where it changes faster, a nearer one.
constexpr double kNearEnough = 0.4;
constexpr double kNearEnoughAtEdges = 0.3;
/// And one of more points than it has samples a further one: it reads as well there.
constexpr double kNearEnoughInCrowds = 0.6;
constexpr double kWellWithin = 0.6;
/// So near to a centre no second patch is fitted, wherever the middle of its points lies.
constexpr double kAlmostThere = 0.15;
/// A section needs some hundred; points that ask for more form no surface.
constexpr std::size_t kMostPatches = 1500;

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

}  // namespace

BlendedSurface::BlendedSurface(PatchFitter fitter) : fitter_(std::move(fitter)) {}

BlendedSurface::Zone::Zone(const SurfacePatch& patch) : centre(patch.centre), middle(patch.middle) {
  const bool smooth = std::holds_alternative<HeightPatch>(patch.field);
  const double square = patch.radius * patch.radius;
  almost_there = kAlmostThere * kAlmostThere * square;
  const bool crowded = patch.members.size() > kMostHeightSamples;
  const double near = smooth ? (crowded ? kNearEnoughInCrowds : kNearEnough) : kNearEnoughAtEdges;
  near_enough = near * near * square;
  well_within = kWellWithin * kWellWithin * square;
  reach = kReach * kReach * square;
}

bool BlendedSurface::Zone::serves(const Eigen::Vector3d& place) const {
  const double off = (place - centre).squaredNorm();
  if (off < almost_there) return true;
  return off < near_enough && (place - middle).squaredNorm() < well_within;
}

bool BlendedSurface::visit(const Eigen::Vector3d& place) {
  const auto serves = [&](const Zone& zone) { return zone.serves(place); };
  if (std::any_of(zones_.rbegin(), zones_.rend(), serves)) return true;
  if (patches_.size() >= kMostPatches) return false;
  auto patch = fitter_.fit(place);
  if (!patch) return false;
  patches_.push_back(std::move(*patch));
  zones_.emplace_back(patches_.back());
  return true;
}

std::optional<FieldValue> BlendedSurface::at(const Eigen::Vector3d& place) const {
  double weights = 0.0;
  Eigen::Vector3d weights_gradient = Eigen::Vector3d::Zero();
  FieldValue sum;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if ((place - zones_[i].middle).squaredNorm() >= zones_[i].reach) continue;
    const SurfacePatch& patch = patches_[i];
    const Weight weight = wendland(place - patch.middle, kReach * patch.radius);
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

const SurfacePatch* BlendedSurface::leading_patch(const Eigen::Vector3d& place) const {
  const SurfacePatch* leading = nullptr;
  double most = 0.0;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if ((place - zones_[i].middle).squaredNorm() >= zones_[i].reach) continue;
    const SurfacePatch& patch = patches_[i];
    const double weight = wendland(place - patch.middle, kReach * patch.radius).value;
    if (weight <= most) continue;
    most = weight;
    leading = &patch;
  }
  return leading;
}

double BlendedSurface::distance_to_data(const Eigen::Vector3d& place) const {
  return std::sqrt(fitter_.index().nearest(place, 1).front().squared_distance);
}

}  // namespace instep
