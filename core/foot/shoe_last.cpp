#include "core/foot/shoe_last.h"

#include <utility>
#include <vector>

#include "core/median.h"

namespace instep {
namespace {

constexpr double kHeelShare = 0.15;
constexpr double kRaisedShare = 0.02;
constexpr double kHighestShare = 0.45;
constexpr double kStrayShare = 0.01;

}  // namespace

bool is_shoe_last(const FootScan& foot) {
  const auto front = foot.landmarks.find("acropodion");
  if (front == foot.landmarks.end() || foot.has_seen_toes()) return false;
  const double length = front->second.position_mm.x();
  std::vector<double> heights;
  std::vector<double> heel;
  for (const auto& point : foot.cloud.positions) {
    heights.push_back(point.z());
    if (point.x() < kHeelShare * length) heel.push_back(point.z());
  }
  if (heel.empty()) return false;
  return quantile(std::move(heel), kStrayShare) > kRaisedShare * length &&
         quantile(std::move(heights), 1.0 - kStrayShare) < kHighestShare * length;
}

}  // namespace instep
