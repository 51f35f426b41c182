#include "core/foot/quieted.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/moments.h"
#include "core/geometry/point_index.h"
#include "core/geometry/quadratic_skin.h"
#include "core/median.h"
#include "core/picked.h"
#include "core/some_of.h"
#include "core/surface/noise_estimate.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Places at which the points are asked for their noise: of a real foot it is told to a tenth.
constexpr std::size_t kAskedPlaces = 100;
constexpr double kNoisyMm = 0.2;
/// Neighbours are taken from so many: of a denser cloud more say nothing new.
constexpr std::size_t kMostNeighbours = 40000;
constexpr double kNarrowestMm = 6.0;
constexpr double kWidestMm = 12.0;
constexpr double kRadiusInNoise = 4.0;
constexpr std::size_t kFewest = 12;
constexpr std::size_t kUsual = 20;
/// A point further off in deviations is a stray.
constexpr double kFurthestOff = 4.0;

/// As wide as the noise asks for, and as holds enough neighbours at most places.
double radius_for(const PointIndex& index, double noise_mm) {
  std::vector<double> reaches;
  for (const std::size_t place : some_of(index.points().size(), kAskedPlaces)) {
    const auto neighbours = index.nearest(index.points()[place], kUsual);
    reaches.push_back(std::sqrt(neighbours.back().squared_distance));
  }
  const double asked = std::max(kRadiusInNoise * noise_mm, median(std::move(reaches)));
  return std::clamp(asked, kNarrowestMm, kWidestMm);
}

Vector3d on_skin(const PointIndex& index, const Vector3d& point, double radius, double noise_mm) {
  const auto neighbours = index.around(point, radius);
  if (neighbours.size() < kFewest) return point;
  Moments moments;
  for (const auto& neighbour : neighbours) moments.add(index.points()[neighbour.index] - point);
  const Vector3d normal = moments.flattest();
  const Vector3d across = normal.unitOrthogonal();
  const Vector3d upright = normal.cross(across);
  SkinPatch patch;
  patch.reserve(neighbours.size());
  for (const auto& neighbour : neighbours) {
    const Vector3d offset = index.points()[neighbour.index] - point;
    patch.emplace_back(across.dot(offset), upright.dot(offset), normal.dot(offset));
  }
  const auto skin = QuadraticSkin::through(patch);
  if (!skin) return point;
  const double off = skin->at(0.0, 0.0);
  return std::abs(off) < kFurthestOff * noise_mm ? Vector3d(point + off * normal) : point;
}

}  // namespace

PointCloud quieted(const PointCloud& cloud, double noise_mm, std::size_t most) {
  const PointIndex index(picked(cloud.positions, some_of(cloud.size(), kMostNeighbours)));
  PointCloud quiet = cloud.subset(some_of(cloud.size(), most));
  const double radius = radius_for(index, noise_mm);
  for (std::size_t i = 0; i < quiet.size(); ++i) {
    if (quiet.was_seen(i))
      quiet.positions[i] = on_skin(index, quiet.positions[i], radius, noise_mm);
  }
  return quiet;
}

std::optional<QuietedCloud> quieted_if_noisy(const PointCloud& cloud) {
  const PointIndex all(cloud.positions);
  const double noise_mm = estimate_noise(all, some_of(cloud.size(), kAskedPlaces), {}).shown;
  if (noise_mm < kNoisyMm) return std::nullopt;
  return QuietedCloud{quieted(cloud, noise_mm, kMostQuieted), noise_mm};
}

}  // namespace instep
