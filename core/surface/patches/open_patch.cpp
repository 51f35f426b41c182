#include "core/surface/patches/open_patch.h"

#include <cmath>
#include <cstddef>
#include <variant>

namespace instep {
namespace {

/// Of the radius, to the nearest point: nearer ones tell the middle.
constexpr double kAtRims = 0.5;
/// Standard deviation of the height in the middle by the noise of the points, against the radius.
/// Amid points it is 0.01, over holes that a patch spans well up to 0.03; of those that bulge 1.
constexpr double kMostOpen = 0.1;

}  // namespace

bool is_open(const SurfacePatch& patch, double nearest, const std::vector<OrientedPoint>& points) {
  if (nearest < kAtRims * patch.radius) return false;
  const auto sums =
      std::get<HeightPatch>(patch.field).sums({patch.centre}, Eigen::MatrixXd::Ones(1, 1));
  double variance = 0.0;
  for (std::size_t i = 0; i < patch.members.size(); ++i) {
    const double influence = sums.influence(static_cast<Eigen::Index>(i), 0);
    variance += influence * influence * points[patch.members[i]].variance;
  }
  return variance > std::pow(kMostOpen * patch.radius, 2);
}

}  // namespace instep
