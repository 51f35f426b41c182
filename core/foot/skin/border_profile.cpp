#include "core/foot/skin/border_profile.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/extent.h"

namespace instep {
namespace {

constexpr double kPointsInStrip = 30.0;
constexpr double kStrayMm = 3.0;
constexpr double kNarrowestSmoothingInStrips = 3.0;
constexpr double kShortSampleWeight = 0.15;
constexpr int kEnvelopeRounds = 4;
constexpr double kSearchStepMm = 0.5;
constexpr std::size_t kFewestSamples = 4;

/// The two furthest points of a strip.
struct Strip {
  Eigen::Vector2d furthest{0.0, -1e300};
  Eigen::Vector2d next{0.0, -1e300};

  void add(const Eigen::Vector2d& point) {
    if (point.y() > furthest.y()) {
      next = std::exchange(furthest, point);
    } else if (point.y() > next.y()) {
      next = point;
    }
  }

  bool is_empty() const { return furthest.y() == -1e300; }

  const Eigen::Vector2d& sample() const {
    const bool is_stray = next.y() > -1e300 && furthest.y() - next.y() > kStrayMm;
    return is_stray ? next : furthest;
  }
};

}  // namespace

BorderProfile::BorderProfile(const std::vector<Eigen::Vector2d>& points,
                             const Eigen::Vector2d& along, const Eigen::Vector2d& reach,
                             double smoothing_mm, double strip_mm, double tightest_bend_mm) {
  if (points.empty()) return;
  const Extent places = extent_along(points, along);
  const double width =
      std::max(strip_mm, kPointsInStrip * places.length() / static_cast<double>(points.size()));
  smoothing_mm_ = std::max(smoothing_mm, kNarrowestSmoothingInStrips * width);
  const double first = std::floor(places.from / width + 0.5);
  const auto strip_of = [&](double place) {
    return static_cast<std::size_t>(std::floor(place / width + 0.5) - first);
  };
  std::vector<Strip> strips(strip_of(places.to) + 1);
  for (const auto& point : points) {
    const double place = along.dot(point);
    strips[strip_of(place)].add({place, reach.dot(point)});
  }
  for (const auto& strip : strips) {
    if (!strip.is_empty()) samples_.push_back({strip.sample().x(), strip.sample().y()});
  }
  std::sort(samples_.begin(), samples_.end(),
            [](const Sample& a, const Sample& b) { return a.place < b.place; });
  if (tightest_bend_mm > 0.0) lift_short_samples(tightest_bend_mm);
}

void BorderProfile::lift_short_samples(double tightest_bend_mm) {
  const std::vector<Sample> as_seen = samples_;
  auto first_near = as_seen.begin();
  for (auto& sample : samples_) {
    while (first_near->place < sample.place - smoothing_mm_) ++first_near;
    for (auto near = first_near; near != as_seen.end(); ++near) {
      const double off = near->place - sample.place;
      if (off > smoothing_mm_) break;
      sample.reach = std::max(sample.reach, near->reach - 0.5 * off * off / tightest_bend_mm);
    }
  }
}

std::optional<double> BorderProfile::reach(double place) const {
  const auto begin =
      std::lower_bound(samples_.begin(), samples_.end(), place - smoothing_mm_,
                       [](const Sample& sample, double value) { return sample.place < value; });
  const auto end =
      std::lower_bound(begin, samples_.end(), place + smoothing_mm_,
                       [](const Sample& sample, double value) { return sample.place < value; });
  if (static_cast<std::size_t>(end - begin) < kFewestSamples) return std::nullopt;
  Eigen::Vector3d fitted(-1e300, 0.0, 0.0);
  std::vector<char> is_short(static_cast<std::size_t>(end - begin), 0);
  for (int round = 0; round < kEnvelopeRounds; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    bool has_changed = round == 0;
    for (auto sample = begin; sample != end; ++sample) {
      const double offset = (sample->place - place) / smoothing_mm_;
      const Eigen::Vector3d terms(1.0, offset, offset * offset);
      const double inwards = 1.0 - offset * offset;
      const double nearness = inwards * inwards + 1e-9;
      const char falls_short = sample->reach < fitted.dot(terms) ? 1 : 0;
      char& was_short = is_short[static_cast<std::size_t>(sample - begin)];
      has_changed = has_changed || falls_short != was_short;
      was_short = falls_short;
      const double weight = nearness * (falls_short != 0 ? kShortSampleWeight : 1.0);
      normal += weight * terms * terms.transpose();
      right += weight * sample->reach * terms;
    }
    if (!has_changed) break;
    fitted = normal.ldlt().solve(right);
    if (!fitted.allFinite()) return std::nullopt;
  }
  return fitted(0);
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
  return Peak{top->place, top->reach};
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
      found.push_back({top.place, top.reach});
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
