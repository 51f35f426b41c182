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
/// Points within this part of the circle share its skin, which tells them no worse.
constexpr double kSharedBy = 0.5;
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

/// A place on the skin, and the skin's directions there.
struct SkinFrame {
  Vector3d place;
  Vector3d across;
  Vector3d upright;
  Vector3d normal;

  Vector3d seen(const Vector3d& point) const {
    const Vector3d arm = point - place;
    return {across.dot(arm), upright.dot(arm), normal.dot(arm)};
  }
};

/// The skin round a place, as its neighbours show it.
struct LocalSkin {
  SkinFrame frame;
  QuadraticSkin shape;

  /// How far along the normal a point has to go to lie on it.
  double off(const Vector3d& point) const {
    const Vector3d seen = frame.seen(point);
    return shape.at(seen.x(), seen.y()) - seen.z();
  }
};

std::optional<LocalSkin> skin_round(const Vector3d& place, const PointIndex& index, double radius) {
  const auto neighbours = index.around(place, radius);
  if (neighbours.size() < kFewest) return std::nullopt;
  Moments moments;
  for (const auto& neighbour : neighbours) moments.add(index.points()[neighbour.index] - place);
  const Vector3d normal = moments.flattest();
  const Vector3d across = normal.unitOrthogonal();
  const SkinFrame frame{place, across, normal.cross(across), normal};
  SkinPatch patch;
  patch.reserve(neighbours.size());
  for (const auto& neighbour : neighbours) {
    patch.push_back(frame.seen(index.points()[neighbour.index]));
  }
  const auto shape = QuadraticSkin::through(patch);
  if (!shape) return std::nullopt;
  return LocalSkin{frame, *shape};
}

}  // namespace

PointCloud quieted(const PointCloud& cloud, double noise_mm, std::size_t most) {
  const PointIndex index(picked(cloud.positions, some_of(cloud.size(), kMostNeighbours)));
  PointCloud quiet = cloud.subset(some_of(cloud.size(), most));
  const PointIndex kept(quiet.positions);
  const double radius = radius_for(index, noise_mm);
  std::vector<bool> is_settled(quiet.size(), false);
  for (std::size_t i = 0; i < quiet.size(); ++i) {
    if (is_settled[i] || !quiet.was_seen(i)) continue;
    const Vector3d& place = kept.points()[i];
    const auto skin = skin_round(place, index, radius);
    if (!skin) continue;
    for (const auto& [near, square] : kept.around(place, kSharedBy * radius)) {
      const double off = skin->off(kept.points()[near]);
      if (is_settled[near] || !quiet.was_seen(near)) continue;
      if (std::abs(off) >= kFurthestOff * noise_mm) continue;
      quiet.positions[near] += off * skin->frame.normal;
      is_settled[near] = true;
    }
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
