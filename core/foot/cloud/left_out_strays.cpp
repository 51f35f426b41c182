#include "core/foot/cloud/left_out_strays.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/foot/cloud/scanner_lines.h"
#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/geometry/strays/haze_points.h"
#include "core/geometry/strays/loose_clumps.h"
#include "core/geometry/strays/stray_points.h"
#include "core/geometry/strays/strays.h"

namespace instep {
namespace {

constexpr std::size_t kSpacingSample = 2000;
/// Of more points the strays among some tell whether there are many. In a dense cloud many have
/// others beside them, and to look for those among all would take minutes.
constexpr std::size_t kMostHunted = 60000;
constexpr double kMany = 0.005;

/// Whether there were any.
bool take_out(const std::vector<bool>& strays, PointCloud& cloud) {
  std::vector<std::size_t> skin;
  for (std::size_t i = 0; i < strays.size(); ++i) {
    if (!strays[i]) skin.push_back(i);
  }
  const bool any = skin.size() < strays.size();
  if (any) cloud = cloud.subset(skin);
  return any;
}

/// Whether there were any. Where a scanner's lines meet skin aslant the last of them are as far
/// from all others.
bool take_out_clumps(double spacing, PointCloud& cloud) {
  const std::vector<bool> clumps = loose_clumps(cloud.positions, spacing);
  if (std::find(clumps.begin(), clumps.end(), true) == clumps.end()) return false;
  const auto lines = scanner_lines(cloud.positions);
  return !(lines && lines->are_apart()) && take_out(clumps, cloud);
}

/// Of so many points.
double share_out_of(std::size_t all, const PointCloud& cloud) {
  return 1.0 - static_cast<double>(cloud.size()) / static_cast<double>(all);
}

/// Those that `strays_in` finds, and clumps. Whether there were any of these.
template <class Finder>
bool take_out_found(const Finder& strays_in, PointCloud& cloud) {
  const PointIndex index(cloud.positions);
  const double spacing = usual_spacing(index, kSpacingSample);
  if (!(spacing > 0.0)) return false;
  take_out(strays_in(index, spacing), cloud);
  return take_out_clumps(spacing, cloud);
}

/// Haze first: in it no stray stands alone.
LeftOutStrays hunted(PointCloud& cloud) {
  const std::size_t all = cloud.size();
  take_out(haze_points(PointIndex(cloud.positions)), cloud);
  const double haze = share_out_of(all, cloud);
  const bool any_clump = take_out_found(
      [&](const PointIndex& index, double spacing) { return strays_among(index, spacing, {haze}); },
      cloud);
  return {share_out_of(all, cloud), any_clump};
}

LeftOutStrays taken_out_alone(PointCloud& cloud) {
  const std::size_t all = cloud.size();
  const bool any_clump = take_out_found(stray_points, cloud);
  return {share_out_of(all, cloud), any_clump};
}

}  // namespace

LeftOutStrays leave_out_strays(PointCloud& cloud) {
  if (cloud.positions.empty() || !cloud.origins.empty()) return {};
  if (cloud.size() <= kMostHunted) return hunted(cloud);
  auto some = some_by_place(cloud.positions, kMostHunted);
  std::sort(some.begin(), some.end());
  PointCloud sample = cloud.subset(some);
  const LeftOutStrays of_some = hunted(sample);
  if (of_some.share <= kMany) return taken_out_alone(cloud);
  cloud = std::move(sample);
  return of_some;
}

}  // namespace instep
