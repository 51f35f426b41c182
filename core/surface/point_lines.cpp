#include "core/surface/point_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bitset>
#include <cmath>
#include <numbers>
#include <optional>

namespace instep {
namespace {

constexpr int kDirections = 36;
/// Bins across the whole reach, to both sides.
constexpr int kBins = 64;
constexpr int kFirstBin = kBins / 4;
constexpr int kLastBin = kBins - kBins / 4;

using Bins = std::bitset<kBins>;

Bins bins_of(const std::vector<Eigen::Vector3d>& arms, const Eigen::Vector3d& across,
             double reach) {
  Bins bins;
  const Eigen::Vector3d scaled = across * (0.5 * kBins / reach);
  for (const auto& arm : arms) {
    const int bin = static_cast<int>(scaled.dot(arm) + 0.5 * kBins);
    bins.set(static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1)));
  }
  return bins;
}

/// From one taken bin to the next: the second widest of all steps, but at most the widest near the
/// middle. A single wide one is a hole.
int second_widest_step(const Bins& bins) {
  int widest = 0;
  int second = 0;
  int near_middle = 0;
  std::optional<int> last;
  for (int bin = 0; bin < kBins; ++bin) {
    if (!bins[static_cast<std::size_t>(bin)]) continue;
    const int step = bin - last.value_or(bin);
    second = std::max(second, std::min(step, widest));
    widest = std::max(widest, step);
    if (last >= kFirstBin && bin < kLastBin) near_middle = std::max(near_middle, step);
    last = bin;
  }
  return std::min(second, near_middle);
}

}  // namespace

PointLines lines_among(const std::vector<Eigen::Vector3d>& arms, const Eigen::Vector3d& outward,
                       double reach) {
  const Eigen::Vector3d east = outward.unitOrthogonal();
  const Eigen::Vector3d north = outward.cross(east);
  PointLines lines{east, 0.0};
  int widest = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = std::numbers::pi * i / kDirections;
    const Eigen::Vector3d across = std::cos(angle) * east + std::sin(angle) * north;
    const int step = second_widest_step(bins_of(arms, across, reach));
    if (step <= widest) continue;
    widest = step;
    lines.across = across;
  }
  lines.apart = reach * widest / (0.5 * kBins);
  return lines;
}

}  // namespace instep
