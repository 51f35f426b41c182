#include "core/foot/border_profile.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

namespace instep {
namespace {

constexpr double kStripMm = 2.0;
constexpr double kSearchStepMm = 0.5;
constexpr std::size_t kFewestSamples = 4;

/// Median of the three furthest, which a single stray does not move; the furthest of fewer.
Eigen::Vector2d furthest_point(std::vector<Eigen::Vector2d>& points) {
  const std::size_t count = std::min<std::size_t>(3, points.size());
  std::partial_sort(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count),
                    points.end(), [](const auto& a, const auto& b) { return a.y() > b.y(); });
  return points[count == 3 ? 1 : 0];
}

}  // namespace

BorderProfile::BorderProfile(const std::vector<Eigen::Vector2d>& points,
                             const Eigen::Vector2d& along, const Eigen::Vector2d& reach,
                             double smoothing_mm)
    : smoothing_mm_(smoothing_mm) {
  std::map<long, std::vector<Eigen::Vector2d>> strips;
  for (const auto& point : points) {
    const double place = along.dot(point);
    strips[std::lround(place / kStripMm)].emplace_back(place, reach.dot(point));
  }
  for (auto& [number, strip] : strips) {
    const Eigen::Vector2d sample = furthest_point(strip);
    samples_.push_back({sample.x(), sample.y()});
  }
  std::sort(samples_.begin(), samples_.end(),
            [](const Sample& a, const Sample& b) { return a.place < b.place; });
}

std::optional<double> BorderProfile::reach(double place) const {
  const auto begin =
      std::lower_bound(samples_.begin(), samples_.end(), place - smoothing_mm_,
                       [](const Sample& sample, double value) { return sample.place < value; });
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (auto sample = begin; sample != samples_.end() && sample->place < place + smoothing_mm_;
       ++sample, ++count) {
    const double offset = (sample->place - place) / smoothing_mm_;
    const double weight = std::pow(1.0 - offset * offset, 2);
    const Eigen::Vector3d terms(1.0, offset, offset * offset);
    normal += weight * terms * terms.transpose();
    right += weight * sample->reach * terms;
  }
  if (count < kFewestSamples) return std::nullopt;
  const double fitted = normal.ldlt().solve(right)(0);
  return std::isfinite(fitted) ? std::optional<double>(fitted) : std::nullopt;
}

std::vector<BorderProfile::Sample> BorderProfile::curve(double from, double to) const {
  std::vector<Sample> curve;
  const auto steps = static_cast<int>((to - from) / kSearchStepMm);
  for (int i = 0; i <= steps; ++i) {
    const double place = from + i * kSearchStepMm;
    if (const auto value = reach(place)) curve.push_back({place, *value});
  }
  return curve;
}

std::optional<BorderProfile::Peak> BorderProfile::furthest(double from, double to) const {
  const auto border = curve(from, to);
  if (border.empty()) return std::nullopt;
  const auto top =
      std::max_element(border.begin(), border.end(),
                       [](const Sample& a, const Sample& b) { return a.reach < b.reach; });
  const double higher_end = std::max(border.front().reach, border.back().reach);
  return Peak{top->place, top->reach, top->reach - higher_end};
}

std::vector<BorderProfile::Peak> BorderProfile::summits(double from, double to, double fall) const {
  std::vector<Peak> found;
  const auto border = curve(from, to);
  if (border.empty()) return found;
  Sample top = border.front();
  double valley = border.front().reach;
  bool is_climbing = false;
  for (const auto& sample : border) {
    if (sample.reach > top.reach) top = sample;
    valley = std::min(valley, sample.reach);
    if (is_climbing && sample.reach < top.reach - fall) {
      found.push_back({top.place, top.reach, top.reach - valley});
      is_climbing = false;
      valley = sample.reach;
    } else if (!is_climbing && sample.reach > valley + fall) {
      is_climbing = true;
      top = sample;
    }
  }
  return found;
}

}  // namespace instep
