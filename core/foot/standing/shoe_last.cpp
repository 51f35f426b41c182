#include "core/foot/standing/shoe_last.h"

#include <cmath>
#include <utility>
#include <vector>

#include "core/foot/axis/outline_axis.h"
#include "core/median.h"

namespace instep {
namespace {

constexpr double kRaisedShare = 0.02;
constexpr double kHighestShare = 0.45;
constexpr double kStrayShare = 0.01;
constexpr double kNearFloorMm = 4.0;
constexpr double kOnFloorMm = 1.0;
constexpr double kFlatShare = 0.5;
constexpr double kFlatLength = 0.8;
constexpr double kStrayOnFloor = 0.02;

}  // namespace

bool is_shoe_last(const FootScan& foot) {
  const auto front = foot.landmarks.find("acropodion");
  if (front == foot.landmarks.end() || foot.has_seen_toes()) return false;
  const double length = front->second.position_mm.x();
  std::vector<double> heights;
  std::vector<double> heel;
  for (const auto& point : foot.shape().positions) {
    heights.push_back(point.z());
    if (point.x() < kHeelShare * length) heel.push_back(point.z());
  }
  if (heel.empty()) return false;
  return quantile(std::move(heel), kStrayShare) > kRaisedShare * length &&
         quantile(std::move(heights), 1.0 - kStrayShare) < kHighestShare * length;
}

bool stands_flat(const FootScan& foot) {
  double near = 0.0;
  std::vector<double> on_floor;  // their places along the foot
  for (const auto& point : foot.shape().positions) {
    if (point.z() < kNearFloorMm) near += 1.0;
    if (std::abs(point.z()) < kOnFloorMm) on_floor.push_back(point.x());
  }
  if (on_floor.empty() || static_cast<double>(on_floor.size()) < kFlatShare * near) return false;
  const double reach = quantile(on_floor, 1.0 - kStrayOnFloor) - quantile(on_floor, kStrayOnFloor);
  return reach > kFlatLength * foot.length_mm();
}

}  // namespace instep
