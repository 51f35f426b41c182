#include "core/foot/left_out_strays.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/foot/scanner_lines.h"
#include "core/geometry/haze_points.h"
#include "core/geometry/loose_clumps.h"
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

/// Those that `strays_in` finds, and clumps.
template <class Finder>
LeftOutStrays take_out(PointCloud& cloud, const Finder& strays_in) {
  LeftOutStrays left_out;
  const PointIndex index(cloud.positions);
  const double spacing = usual_spacing(index, kSpacingSample);
  if (!(spacing > 0.0)) return left_out;
  take_out(strays_in(index, spacing), cloud);
  const std::vector<bool> clumps = loose_clumps(cloud.positions, spacing);
  const bool any = std::find(clumps.begin(), clumps.end(), true) != clumps.end();
  // Where a scanner's lines meet skin aslant the last of them are as far from all others.
  if (any) {
    const auto lines = scanner_lines(cloud.positions);
    left_out.any_clump = !(lines && lines->are_apart()) && take_out(clumps, cloud);
  }
  const auto all = static_cast<double>(index.points().size());
  left_out.share = 1.0 - static_cast<double>(cloud.size()) / all;
  return left_out;
}

/// Haze first: in it no stray stands alone.
LeftOutStrays take_out_all(PointCloud& cloud) {
  if (cloud.positions.empty()) return {};
  const auto all = static_cast<double>(cloud.size());
  const auto share_out = [&] { return 1.0 - static_cast<double>(cloud.size()) / all; };
  take_out(haze_points(PointIndex(cloud.positions)), cloud);
  LeftOutStrays left_out =
      take_out(cloud, [&, haze = share_out()](const PointIndex& index, double spacing) {
        return strays_among(index, spacing, {haze});
      });
  left_out.share = share_out();
  return left_out;
}

}  // namespace

LeftOutStrays leave_out_strays(PointCloud& cloud) {
  if (!cloud.origins.empty()) return {};
  if (cloud.size() <= kMostHunted) return take_out_all(cloud);
  auto some = some_by_place(cloud.positions, kMostHunted);
  std::sort(some.begin(), some.end());
  PointCloud sample = cloud.subset(some);
  const LeftOutStrays of_some = take_out_all(sample);
  if (of_some.share <= kMany) return take_out(cloud, stray_points);
  cloud = std::move(sample);
  return of_some;
}

}  // namespace instep
