#include "core/geometry/strays/off_skin_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/moments.h"
#include "core/median.h"

namespace instep {
namespace {

constexpr std::size_t kNeighbours = 12;
/// Twice as many are looked at, so that some may be off the skin themselves.
constexpr std::size_t kLookedAt = 24;
/// The furthest ones of them from their plane have no say in it.
constexpr std::size_t kSilent = 3;
constexpr double kLeastRise = 0.25;
constexpr double kTimesUsual = 6.0;
constexpr int kRounds = 4;

struct Flat {
  Eigen::Vector3d normal;
  double level = 0.0;

  double distance(const Eigen::Vector3d& arm) const { return std::abs(normal.dot(arm) - level); }
};

template <typename Iterator>
Flat plane_of(Iterator begin, Iterator end) {
  Moments moments;
  for (auto arm = begin; arm != end; ++arm) moments.add(*arm);
  const Eigen::Vector3d normal = moments.flattest();
  return {normal, normal.dot(moments.middle())};
}

/// Of a point against the plane of those round it, and what they mostly are off that plane.
struct Rise {
  double own = 0.0;
  double usual = 0.0;
};

Rise rise_of(const PointIndex& index, std::size_t point, const std::vector<bool>& off) {
  const Eigen::Vector3d& here = index.points()[point];
  std::vector<Eigen::Vector3d> arms;
  for (const auto& neighbour : index.nearest(here, kLookedAt)) {
    if (neighbour.index == point || off[neighbour.index] || arms.size() == kNeighbours) continue;
    arms.push_back(index.points()[neighbour.index] - here);
  }
  if (arms.size() < kNeighbours) return {};
  Flat flat = plane_of(arms.begin(), arms.end());
  std::sort(arms.begin(), arms.end(),
            [&](const auto& a, const auto& b) { return flat.distance(a) < flat.distance(b); });
  flat = plane_of(arms.begin(), arms.end() - kSilent);
  std::vector<double> rises;
  for (const auto& arm : arms) rises.push_back(flat.distance(arm));
  return {flat.distance(Eigen::Vector3d::Zero()), median(std::move(rises))};
}

}  // namespace

std::vector<bool> off_skin_points(const PointIndex& index, double spacing) {
  const std::size_t count = index.points().size();
  std::vector<bool> off(count, false);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Rise> rises(count);
    std::vector<double> usual;
    for (std::size_t i = 0; i < count; ++i) {
      if (off[i]) continue;
      rises[i] = rise_of(index, i, off);
      usual.push_back(rises[i].usual);
    }
    // Few neighbours may lie flat by chance: noise that is everywhere is here as well.
    const double everywhere = median(std::move(usual));
    bool found = false;
    for (std::size_t i = 0; i < count; ++i) {
      const double most = kTimesUsual * std::max(rises[i].usual, everywhere);
      if (rises[i].own <= std::max(kLeastRise * spacing, most)) continue;
      off[i] = true;
      found = true;
    }
    if (!found) break;
  }
  return off;
}

}  // namespace instep
