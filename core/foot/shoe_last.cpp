#include "core/foot/shoe_last.h"

#include <algorithm>
#include <vector>

namespace instep {
namespace {

constexpr double kSureToe = 0.5;  ///< confidence from which the second toe was seen as one
constexpr double kHeelShare = 0.15;
constexpr double kRaisedShare = 0.02;
constexpr double kHighestShare = 0.45;
constexpr double kStrayShare = 0.01;

double quantile(std::vector<double> values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace

bool is_shoe_last(const FootScan& foot) {
  const auto toe = foot.landmarks.find("toe2_tip");
  const auto front = foot.landmarks.find("acropodion");
  if (toe == foot.landmarks.end() || front == foot.landmarks.end()) return false;
  if (toe->second.confidence > kSureToe) return false;
  const double length = front->second.position_mm.x();
  std::vector<double> heights;
  std::vector<double> heel;
  for (const auto& point : foot.cloud.positions) {
    heights.push_back(point.z());
    if (point.x() < kHeelShare * length) heel.push_back(point.z());
  }
  if (heel.empty()) return false;
  return quantile(heel, kStrayShare) > kRaisedShare * length &&
         quantile(heights, 1.0 - kStrayShare) < kHighestShare * length;
}

}  // namespace instep
