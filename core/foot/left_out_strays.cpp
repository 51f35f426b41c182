#include "core/foot/left_out_strays.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/geometry/stray_points.h"
#include "core/geometry/strays.h"

namespace instep {
namespace {

constexpr std::size_t kSpacingSample = 2000;
/// Of more points the strays among some tell whether there are many. In a dense cloud many have
/// others beside them, and to look for those among all would take minutes.
constexpr std::size_t kMostHunted = 60000;
constexpr double kMany = 0.005;

/// Takes out those that `strays_in` finds; returns their share.
template <class Finder>
double take_out(PointCloud& cloud, const Finder& strays_in) {
  const PointIndex index(cloud.positions);
  const double spacing = usual_spacing(index, kSpacingSample);
  if (!(spacing > 0.0)) return 0.0;
  const std::vector<bool> strays = strays_in(index, spacing);
  std::vector<std::size_t> skin;
  for (std::size_t i = 0; i < strays.size(); ++i) {
    if (!strays[i]) skin.push_back(i);
  }
  if (skin.size() == strays.size()) return 0.0;
  cloud = cloud.subset(skin);
  return 1.0 - static_cast<double>(skin.size()) / static_cast<double>(strays.size());
}

double take_out_all(PointCloud& cloud) {
  return take_out(
      cloud, [](const PointIndex& index, double spacing) { return strays_among(index, spacing); });
}

}  // namespace

double leave_out_strays(PointCloud& cloud) {
  if (!cloud.origins.empty()) return 0.0;
  if (cloud.size() <= kMostHunted) return take_out_all(cloud);
  auto some = some_by_place(cloud.positions, kMostHunted);
  std::sort(some.begin(), some.end());
  PointCloud sample = cloud.subset(some);
  const double share = take_out_all(sample);
  if (share <= kMany) return take_out(cloud, stray_points);
  cloud = std::move(sample);
  return share;
}

}  // namespace instep
