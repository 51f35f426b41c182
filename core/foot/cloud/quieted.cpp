#include "core/foot/cloud/quieted.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/foot/full_size.h"
#include "core/foot/skin/skin_noise.h"
#include "core/geometry/moments_round.h"
#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"
#include "core/geometry/quadratic_skin.h"
#include "core/picked.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Places at which the points are asked for their noise: of a real foot it is told to a tenth.
constexpr std::size_t kAskedPlaces = 100;
constexpr double kMovingMm = 0.2;
constexpr double kStepsToALine = 1.5;  ///< that are kept of those from one line to the next
/// Of a whole cloud so many are kept and asked, of a part at most so many kept: all of few points.
constexpr std::size_t kMostAsked = 100000;
constexpr std::size_t kMostOfPart = 9000;
/// Of circles, at full size.
constexpr double kNarrowestMm = 6.0;
constexpr double kWidestMm = 12.0;
constexpr double kRadiusInNoise = 4.0;
/// How far off the skin of a place points may lie that tell of it.
constexpr double kColumnInNoise = 3.0;
constexpr double kColumnInRadii = 0.25;
constexpr std::size_t kFewest = 12;
constexpr std::size_t kUsual = 20;
/// Points within this part of the circle share its skin, which tells them no worse.
constexpr double kSharedBy = 0.4;
/// A point further off in deviations is a stray.
constexpr double kFurthestOff = 4.0;

/// Of points on lines as few on each as show the lines beside it: the nearest ones of all are on
/// one line, which tells no skin.
std::vector<Vector3d> spread_evenly(const std::vector<Vector3d>& points,
                                    const ScannerLines& lines) {
  const double kept = std::min(1.0, kStepsToALine * lines.step_mm / lines.pitch_mm);
  const auto count = static_cast<std::size_t>(kept * static_cast<double>(points.size()));
  return picked(points, some_by_place(points, count));
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

/// Those that may tell of others.
PointIndex asked_of(const PointCloud& cloud, std::size_t most) {
  std::vector<Vector3d> seen;
  seen.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.was_seen(i)) seen.push_back(cloud.positions[i]);
  }
  if (seen.size() > most) seen = picked(seen, some_by_place(seen, most));
  return PointIndex(std::move(seen));
}

/// As wide as the noise asks for, and as holds enough of those round a place.
double radius_at(const Vector3d& place, const PointIndex& asked, const Quieting& quieting) {
  const double size = 1.0 / full_size_factor(quieting.length_mm);
  const auto usual = asked.nearest(place, kUsual + 1);
  const double wanted =
      std::max(kRadiusInNoise * quieting.noise_mm, std::sqrt(usual.back().squared_distance));
  return std::clamp(wanted, size * kNarrowestMm, size * kWidestMm);
}

/// Of a round column that stands on the skin: of a ball round a place, noise towards the place
/// would count for more than noise away from it, and bend the skin inwards.
std::optional<LocalSkin> skin_round(const Vector3d& place, const PointIndex& asked, double radius,
                                    double noise_mm) {
  const double height = std::min(radius, kColumnInNoise * noise_mm + kColumnInRadii * radius);
  const auto neighbours = asked.around(place, std::hypot(radius, height));
  if (neighbours.size() < kFewest) return std::nullopt;
  const Vector3d normal = moments_round(asked, place, neighbours).flattest();
  const Vector3d across = normal.unitOrthogonal();
  const SkinFrame frame{place, across, normal.cross(across), normal};
  SkinPatch patch;
  patch.reserve(neighbours.size());
  for (const auto& neighbour : neighbours) {
    const Vector3d seen = frame.seen(asked.points()[neighbour.index]);
    if (seen.head<2>().norm() < radius) patch.push_back(seen);
  }
  if (patch.size() < kFewest) return std::nullopt;
  const auto shape = QuadraticSkin::through(patch);
  if (!shape) return std::nullopt;
  return LocalSkin{frame, *shape};
}

/// Puts each on the skin round the first of them that it lies near.
void settle(std::vector<Vector3d>& places, const std::vector<bool>& is_seen,
            const PointIndex& asked, const Quieting& quieting) {
  const PointIndex before(places);
  std::vector<bool> is_settled(places.size(), false);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (is_settled[i] || !is_seen[i]) continue;
    const Vector3d& place = before.points()[i];
    const double radius = radius_at(place, asked, quieting);
    const auto skin = skin_round(place, asked, radius, quieting.noise_mm);
    if (!skin) continue;
    for (const auto& [near, square] : before.around(place, kSharedBy * radius)) {
      if (is_settled[near] || !is_seen[near]) continue;
      const double off = skin->off(places[near]);
      if (std::abs(off) >= kFurthestOff * quieting.noise_mm) continue;
      places[near] += off * skin->frame.normal;
      is_settled[near] = true;
    }
  }
}

}  // namespace

std::optional<double> moving_noise_mm(const PointCloud& cloud,
                                      const std::optional<ScannerLines>& lines) {
  const auto all = lines ? spread_evenly(cloud.positions, *lines) : cloud.positions;
  const double noise_mm = SkinNoise(all).deviation_mm(some_by_place(all, kAskedPlaces));
  return noise_mm < kMovingMm ? std::nullopt : std::optional(noise_mm);
}

QuietedCloud quieted(const PointCloud& cloud, const Quieting& quieting) {
  const PointIndex asked = asked_of(cloud, kMostAsked / quieting.parts);
  const std::size_t most = quieting.parts > 1 ? kMostOfPart : kMostQuieted;
  QuietedCloud quiet{cloud.subset(some_by_place(cloud.positions, most)), quieting};
  std::vector<bool> is_seen;
  for (std::size_t i = 0; i < quiet.cloud.size(); ++i) is_seen.push_back(quiet.cloud.was_seen(i));
  settle(quiet.cloud.positions, is_seen, asked, quieting);
  return quiet;
}

}  // namespace instep
