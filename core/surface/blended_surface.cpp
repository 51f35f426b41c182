#include "core/surface/blended_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/median.h"

namespace instep {
namespace {

/// Points of a patch: enough to fit a surface, few enough to solve quickly.
constexpr std::size_t kPatchPoints = 60;
/// A place whose points have their middle further off, against their reach, lies in a hole; holes
/// wider than this part of the body are not spanned.
constexpr double kOneSided = 0.5;
constexpr double kWidestHole = 0.15;
/// Nearest points that tell which way is out.
constexpr std::size_t kFacingPoints = 8;
/// Cosine to that direction from which a point can be a height over the patch, and below which it
/// lies on the other side of a thin part.
constexpr double kFacing = 0.5;
constexpr double kBehind = -0.3;
/// With more than this part of the points on the other side, the patch is one in space.
constexpr double kThin = 0.1;
constexpr std::size_t kPointsInSpace = 80;
/// The shape between the estimates of roughness may be rougher than they are.
constexpr double kAllowanceInSpace = 4.0;
/// Heights this many median deviations off, and this part of the radius, are those of strays.
constexpr double kStrayDeviations = 5.0;
constexpr double kStrayRise = 0.7;
/// Where there is noise, a patch is wider than the kriging's bandwidth by this factor, up to this
/// part of the body.
constexpr double kBandwidths = 2.5;
constexpr double kWidest = 0.15;
/// It is fitted again, narrower, if it turns out rougher than thought.
constexpr int kMostAttempts = 4;
constexpr double kTooWide = 1.5;
/// A crease turns at least this much (radians), and is so much likelier than one smooth sheet.
constexpr double kLeastTurn = 0.9;
constexpr double kLeastGain = 8.0;
/// Its place is a guess where the points of a sheet are further from it, in spacings.
constexpr double kWidestCreaseGap = 1.4;
/// A patch counts up to this part of its radius round the middle of its points, beyond which it has
/// none on all sides.
constexpr double kReach = 0.75;
/// A place needs a patch centred within this part of the patch's radius.
constexpr double kNearEnough = 0.35;
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

std::vector<Eigen::Vector3d> positions_of(const std::vector<OrientedPoint>& points) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(points.size());
  for (const auto& point : points) positions.push_back(point.position);
  return positions;
}

Eigen::Vector3d middle_of(const std::vector<OrientedPoint>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points) sum += point.position;
  return sum / static_cast<double>(points.size());
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
    const double off = (place - patch.centre).norm();
    if (off < kAlmostThere * patch.radius) return true;
    if (off < kNearEnough * patch.radius &&
        (place - patch.middle).norm() < kWellWithin * patch.radius) {
      return true;
    }
  }
  if (patches_.size() >= kMostPatches) return false;
  auto patch = fit(place);
  if (!patch) return false;
  patches_.push_back(std::move(*patch));
  return true;
}

/// Over which distance noise and roughness weigh the same.
double BlendedSurface::Surroundings::bandwidth(double of_roughness) const {
  return std::pow(noise_area / of_roughness, 0.2);
}

/// The nearest points; more of them in a hole, until they lie on all sides, so that the surface
/// spans it and is not put forth from one side.
BlendedSurface::Neighbours BlendedSurface::nearest_all_round(const Eigen::Vector3d& place) const {
  auto first = index_.nearest(place, kPatchPoints);
  auto nearest = first;
  for (std::size_t count = 2 * kPatchPoints;; count *= 2) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& neighbour : nearest) middle += points_[neighbour.index].position;
    middle /= static_cast<double>(nearest.size());
    const double reach = std::sqrt(nearest.back().squared_distance);
    if ((middle - place).norm() < kOneSided * reach || is_thin(nearest)) return nearest;
    if (reach > kWidestHole || nearest.size() == points_.size()) return first;
    nearest = index_.nearest(place, count);
  }
}

BlendedSurface::Surroundings BlendedSurface::surroundings_of(const Eigen::Vector3d& place) const {
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
  return here;
}

/// Leaves out points that stand off from the others by more than a bend or a crease could.
void BlendedSurface::drop_strays(Members& members) {
  std::vector<double> heights;
  for (const auto& point : members.all) heights.push_back(members.outward.dot(point.position));
  const double level = median(heights);
  std::vector<double> offsets;
  for (const double height : heights) offsets.push_back(std::abs(height - level));
  const double most = std::max(kStrayDeviations * median(offsets), kStrayRise * members.radius);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (offsets[i] <= most) members.all[kept++] = members.all[i];
  }
  members.all.resize(kept);
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
    members.outward += point.normal;
  }
  members.outward.normalize();
  drop_strays(members);
  for (const auto& point : members.all) {
    if (point.normal.dot(members.outward) < kFacing) continue;
    members.front.push_back(point);
    members.front_radius = std::max(members.front_radius, (point.position - place).norm());
  }
  return members;
}

Eigen::Vector3d BlendedSurface::outward_of(const Neighbours& nearest) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::size_t count = std::min(kFacingPoints, nearest.size());
  for (std::size_t i = 0; i < count; ++i) sum += points_[nearest[i].index].normal;
  return sum.normalized();
}

/// Whether the points show both sides of a thin part.
bool BlendedSurface::is_thin(const Neighbours& nearest) const {
  const Eigen::Vector3d outward = outward_of(nearest);
  const auto behind = std::count_if(nearest.begin(), nearest.end(), [&](const auto& one) {
    return points_[one.index].normal.dot(outward) < kBehind;
  });
  return static_cast<double>(behind) > kThin * static_cast<double>(nearest.size());
}

std::optional<BlendedSurface::Patch> BlendedSurface::fit_in_space(
    const Surroundings& surroundings, const Eigen::Vector3d& place) const {
  const bool wider = surroundings.nearest.size() > kPointsInSpace;
  const auto nearest = wider ? surroundings.nearest : index_.nearest(place, kPointsInSpace);
  // Of many, an even sample by their distance.
  const std::size_t stride = (nearest.size() + kPointsInSpace - 1) / kPointsInSpace;
  std::vector<OrientedPoint> members;
  for (std::size_t i = 0; i < nearest.size(); i += stride) {
    members.push_back(points_[nearest[i].index]);
  }
  const double radius = std::sqrt(nearest.back().squared_distance);
  auto field =
      HermitePatch::fit(members, place, radius, kAllowanceInSpace * surroundings.roughness);
  if (!field) return std::nullopt;
  return Patch{place, place, radius, std::move(*field)};
}

std::optional<BlendedSurface::Patch> BlendedSurface::fit(const Eigen::Vector3d& place) const {
  const Surroundings here = surroundings_of(place);
  if (is_thin(here.nearest)) return fit_in_space(here, place);
  double width = std::min(kBandwidths * here.bandwidth(here.roughness), kWidest);
  for (int attempt = 1;; ++attempt) {
    const Members members = members_of(here, place, width);
    // Noise hides a roughness whose bandwidth is wider than the patch.
    const double likely = std::max(here.roughness, here.noise_area / std::pow(members.radius, 5));
    auto creased = CreasedPatch::fit(members.all, place, members.radius, likely);
    if (creased && creased->turn() > kLeastTurn &&
        creased->gap() < kWidestCreaseGap * here.spacing) {
      const auto smooth =
          HeightPatch::fit(members.all, place, members.outward, members.radius, likely);
      if (!smooth || creased->misfit() + kLeastGain < smooth->misfit()) {
        return Patch{place, middle_of(members.all), members.radius, std::move(*creased)};
      }
    }
    auto smooth =
        HeightPatch::fit(members.front, place, members.outward, members.front_radius, likely);
    if (!smooth) return std::nullopt;
    const double fitting = kBandwidths * here.bandwidth(smooth->roughness());
    if (attempt == kMostAttempts || width <= here.reach || width <= kTooWide * fitting) {
      return Patch{place, middle_of(members.front), members.front_radius, std::move(*smooth)};
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

double BlendedSurface::distance_to_data(const Eigen::Vector3d& place) const {
  return std::sqrt(index_.nearest(place, 1).front().squared_distance);
}

}  // namespace instep
