#include "core/surface/patches/blended_surface.h"

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
/// One of exact points, more than it has samples, may be centred further off, if the place has them
/// on all sides: within a part of the radius this share at least of those that would lie there
/// evenly. Where there is noise, more patches average more of it.
constexpr double kNearEnoughInCrowds = 0.5;
constexpr double kAllRound = 0.3;
constexpr double kLeastAllRound = 0.6;
constexpr double kWellWithin = 0.6;
/// So near to a centre no second patch is fitted, wherever the middle of its points lies.
constexpr double kAlmostThere = 0.15;
/// Places no further from each other share a list of the patches near them, in a unit in which the
/// body is about one long.
constexpr double kNearby = 0.03;
/// A section needs some hundred; points that ask for more form no surface.
constexpr std::size_t kMostPatches = 1500;
/// Of the places where none can be fitted, of which a section has hardly any: lines that lead there
/// end, but of a dense part that the rest does not go on from there are thousands.
constexpr std::size_t kMostFailures = 500;

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

/// Whether a place amid a patch has the patch's points on all sides.
bool is_amid(const Eigen::Vector3d& place, const SurfacePatch& patch,
             const std::vector<OrientedPoint>& points) {
  const double reach = kAllRound * patch.radius;
  const auto found = std::count_if(patch.members.begin(), patch.members.end(), [&](auto member) {
    return (points[member].position - place).squaredNorm() < reach * reach;
  });
  return static_cast<double>(found) >
         kLeastAllRound * kAllRound * kAllRound * static_cast<double>(patch.members.size());
}

}  // namespace

BlendedSurface::BlendedSurface(PatchFitter fitter) : fitter_(std::move(fitter)) {}

BlendedSurface::Zone::Zone(const SurfacePatch& patch) : centre(patch.centre), middle(patch.middle) {
  const auto* smooth = std::get_if<HeightPatch>(&patch.field);
  const bool plain = std::holds_alternative<QuinticPatch>(patch.field);
  const bool crowded =
      plain || (smooth && smooth->is_exact() && patch.members.size() > kMostHeightSamples);
  const double near = smooth || plain ? kNearEnough : kNearEnoughAtEdges;
  const double square = patch.radius * patch.radius;
  almost_there = kAlmostThere * kAlmostThere * square;
  near_enough = near * near * square;
  near_enough_amid = crowded ? kNearEnoughInCrowds * kNearEnoughInCrowds * square : near_enough;
  well_within = kWellWithin * kWellWithin * square;
  reach = kReach * kReach * square;
  const double from_middle = (centre - middle).norm() + kNearEnoughInCrowds * patch.radius;
  neighbourhood = std::pow(std::max(kReach * patch.radius, from_middle) + kNearby, 2);
}

/// Those that may serve or count at a place; the others are too far off.
const std::vector<std::size_t>& BlendedSurface::patches_near(const Eigen::Vector3d& place) const {
  if (near_to_ && (place - *near_to_).squaredNorm() < kNearby * kNearby) return near_;
  near_to_ = place;
  near_.clear();
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    if ((place - zones_[i].middle).squaredNorm() < zones_[i].neighbourhood) near_.push_back(i);
  }
  return near_;
}

bool BlendedSurface::serves(std::size_t patch, const Eigen::Vector3d& place) const {
  const Zone& zone = zones_[patch];
  const double off = (place - zone.centre).squaredNorm();
  if (off < zone.almost_there) return true;
  if (off >= zone.near_enough_amid) return false;
  if ((place - zone.middle).squaredNorm() >= zone.well_within) return false;
  return off < zone.near_enough || is_amid(place, patches_[patch], points());
}

bool BlendedSurface::visit(const Eigen::Vector3d& place) {
  const auto& near = patches_near(place);
  if (std::any_of(near.rbegin(), near.rend(), [&](auto i) { return serves(i, place); }))
    return true;
  if (patches_.size() >= kMostPatches || failures_ >= kMostFailures) return false;
  auto patch = fitter_.fit(place);
  if (!patch) {
    ++failures_;
    return false;
  }
  patches_.push_back(std::move(*patch));
  zones_.emplace_back(patches_.back());
  near_.push_back(zones_.size() - 1);
  return true;
}

std::optional<FieldValue> BlendedSurface::at(const Eigen::Vector3d& place) const {
  double weights = 0.0;
  Eigen::Vector3d weights_gradient = Eigen::Vector3d::Zero();
  FieldValue sum;
  for (const std::size_t i : patches_near(place)) {
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
  for (const std::size_t i : patches_near(place)) {
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

double BlendedSurface::share_with_strays() const {
  if (patches_.empty()) return 0.0;
  const auto with = std::count_if(patches_.begin(), patches_.end(),
                                  [](const SurfacePatch& patch) { return patch.has_strays; });
  return static_cast<double>(with) / static_cast<double>(patches_.size());
}

}  // namespace instep
