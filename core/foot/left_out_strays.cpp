#include "core/foot/left_out_strays.h"

#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/geometry/strays.h"

namespace instep {
namespace {

constexpr std::size_t kSpacingSample = 2000;

}  // namespace

double leave_out_strays(PointCloud& cloud) {
  if (!cloud.origins.empty()) return 0.0;
  const PointIndex index(cloud.positions);
  const double spacing = usual_spacing(index, kSpacingSample);
  if (!(spacing > 0.0)) return 0.0;
  const auto strays = strays_among(index, spacing);
  std::vector<std::size_t> skin;
  for (std::size_t i = 0; i < strays.size(); ++i) {
    if (!strays[i]) skin.push_back(i);
  }
  if (skin.size() == strays.size()) return 0.0;
  cloud = cloud.subset(skin);
  return 1.0 - static_cast<double>(skin.size()) / static_cast<double>(strays.size());
}

}  // namespace instep
