#include "core/foot/scanner_lines.h"

#include <algorithm>
#include <cstddef>

#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"
#include "core/picked.h"

namespace instep {
namespace {

constexpr double kLeastPitchMm = 1.2;
constexpr double kWidestMm = 20.0;  ///< looked at round a point, to see the next line
constexpr std::size_t kMostAsked = 200000;

}  // namespace

std::optional<ScanLines> scanner_lines(const std::vector<Eigen::Vector3d>& points_mm) {
  const auto asked = some_by_place(points_mm, std::min(kMostAsked, points_mm.size()));
  auto lines = scan_lines(PointIndex(picked(points_mm, asked)), kWidestMm);
  if (!lines || lines->pitch < kLeastPitchMm) return std::nullopt;
  return lines;
}

}  // namespace instep
