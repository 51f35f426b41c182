#include "core/foot/skin/skin_border.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/foot/skin/skin_summit.h"
#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kStepMm = 2.0;
constexpr double kWindowMm = 5.0;          ///< half, along and across
constexpr double kDeepestMm = 4.0;         ///< below the furthest: beyond is another face
constexpr double kWidestWindow = 2.1;      ///< times the usual one, where points are few
constexpr std::size_t kFewestPoints = 10;  ///< of a fit
constexpr std::size_t kEnoughPoints = 28;  ///< a window is widened to hold these
constexpr std::size_t kFurthest = 5;
constexpr std::size_t kFewestSamples = 4;
constexpr double kFinestStepMm = 0.02;
constexpr double kWidestBridge = 2.5;  ///< times the smoothing, where samples are missing
constexpr double kWiden = 1.25;
constexpr double kStraySampleMm = 1.5;
constexpr double kStrayInMedians = 4.0;  ///< of how far samples lie off

/// Along, across, outwards: as summit_across() takes them.
using Local = Vector3d;

/// Median of the furthest points in a strip: two strays do not move it.
std::optional<Local> start_of(const std::vector<Local>& strip) {
  if (strip.size() < 3) return std::nullopt;
  const std::size_t count = std::min(kFurthest, strip.size());
  std::vector<Local> furthest(count);
  std::partial_sort_copy(strip.begin(), strip.end(), furthest.begin(), furthest.end(),
                         [](const Local& a, const Local& b) { return a.z() > b.z(); });
  return furthest[count / 2];
}

/// Drops what lies too deep under the furthest points near by to have a say in any place; most of a
/// body does.
void drop_deep(std::vector<Local>& points, const BorderView& view) {
  constexpr double kBinMm = 2.0;
  constexpr long kReachBins = 9;  // of a window at its widest, its strip, and a bin at either end
  double from = 1e300;
  double to = -1e300;
  for (const auto& point : points) {
    from = std::min(from, point.x());
    to = std::max(to, point.x());
  }
  const auto bin_of = [&](const Local& point) {
    return static_cast<std::size_t>((point.x() - from) / kBinMm);
  };
  // A strip is wider than two bins, so that it holds one whole: its start, and all that it is told
  // from, lies no lower than what is found here for the lowest bin near by.
  std::array<double, kFurthest> none;
  none.fill(-1e300);
  std::vector<std::array<double, kFurthest>> furthest(
      static_cast<std::size_t>((to - from) / kBinMm) + 1, none);
  for (const auto& point : points) {
    if (point.y() < view.across_from_mm || point.y() > view.across_to_mm) continue;
    auto& own = furthest[bin_of(point)];
    if (point.z() <= own.back()) continue;
    own.back() = point.z();
    for (std::size_t i = kFurthest - 1; i > 0 && own[i] > own[i - 1]; --i) {
      std::swap(own[i], own[i - 1]);
    }
  }
  std::vector<double> deepest(furthest.size());
  const auto bins = static_cast<long>(furthest.size());
  for (long bin = 0; bin < bins; ++bin) {
    double least = 1e300;
    for (long near = std::max(0L, bin - kReachBins); near <= std::min(bins - 1, bin + kReachBins);
         ++near) {
      least = std::min(least, furthest[static_cast<std::size_t>(near)].back());
    }
    deepest[static_cast<std::size_t>(bin)] = least - kDeepestMm;
  }
  std::erase_if(points, [&](const Local& point) { return point.z() < deepest[bin_of(point)]; });
}

/// Of points sorted by place, the first that is not before it.
std::vector<Local>::const_iterator first_from(double place, const std::vector<Local>& sorted) {
  return std::lower_bound(sorted.begin(), sorted.end(), place,
                          [](const Local& point, double value) { return point.x() < value; });
}

/// The points round the furthest one of a place, seen from there.
struct Surroundings {
  Local start;
  std::vector<Local> points;
  double window_mm = 0.0;  ///< half, along and across
};

/// Nothing where they are all before the place or behind it: within a hole a fit to its edge runs
/// away.
std::optional<Surroundings> surroundings_within(double window, double place,
                                                const std::vector<Local>& sorted,
                                                const BorderView& view) {
  const double thin = 0.5 * window;
  const auto end = first_from(place + window, sorted);
  std::vector<Local> strip;
  for (auto point = first_from(place - thin, sorted); point != end && point->x() < place + thin;
       ++point) {
    const bool is_within = point->y() >= view.across_from_mm && point->y() <= view.across_to_mm;
    if (is_within) strip.push_back(*point);
  }
  const auto start = start_of(strip);
  if (!start) return std::nullopt;
  Surroundings found{*start, {}, window};
  bool is_before = false;
  bool is_behind = false;
  for (auto point = first_from(place - window, sorted); point != end; ++point) {
    if (std::abs(point->y() - start->y()) > window) continue;
    if (point->z() < start->z() - kDeepestMm) continue;
    found.points.emplace_back(point->x() - place, point->y() - start->y(), point->z());
    is_behind = is_behind || found.points.back().x() <= 0.0;
    is_before = is_before || found.points.back().x() >= 0.0;
  }
  return is_before && is_behind ? std::optional(std::move(found)) : std::nullopt;
}

/// Within the narrowest window that holds enough, or in the widest a few.
std::optional<Surroundings> surroundings_of(double place, const std::vector<Local>& sorted,
                                            const BorderView& view) {
  for (double wider = 1.0; wider <= kWidestWindow; wider *= std::sqrt(2.0)) {
    auto found = surroundings_within(wider * kWindowMm, place, sorted, view);
    const bool is_last = wider * std::sqrt(2.0) > kWidestWindow;
    const std::size_t enough = is_last ? kFewestPoints : kEnoughPoints;
    if (found && found->points.size() >= enough) return found;
  }
  return std::nullopt;
}

}  // namespace

SkinBorder::SkinBorder(const std::vector<Vector3d>& points, const BorderView& view,
                       double smoothing_mm)
    : view_(view), smoothing_mm_(smoothing_mm) {
  std::vector<Local> sorted;
  sorted.reserve(points.size());
  const double margin = kWidestWindow * kWindowMm;
  for (const auto& point : points) {
    const Local local(view.along.dot(point), view.across.dot(point), view.outwards.dot(point));
    const bool is_near =
        local.y() > view.across_from_mm - margin && local.y() < view.across_to_mm + margin;
    if (is_near) sorted.push_back(local);
  }
  if (sorted.empty()) return;
  drop_deep(sorted, view);
  std::sort(sorted.begin(), sorted.end(),
            [](const Local& a, const Local& b) { return a.x() < b.x(); });
  const double last = sorted.back().x();
  for (double place = std::ceil(sorted.front().x() / kStepMm) * kStepMm; place <= last;
       place += kStepMm) {
    const auto found = surroundings_of(place, sorted, view);
    if (!found) continue;
    const auto& [start, close, window] = *found;
    const auto summit = summit_across(close, std::max(view.across_from_mm - start.y(), -window),
                                      std::min(view.across_to_mm - start.y(), window));
    if (summit && std::abs(summit->reach - start.z()) < kDeepestMm) {
      samples_.push_back({place, summit->reach, start.y() + summit->across});
    }
  }
}

std::optional<SkinBorder::Reach> SkinBorder::samples_near(double along) const {
  const auto bound = [&](double value) {
    return std::lower_bound(samples_.begin(), samples_.end(), value,
                            [](const Place& sample, double limit) { return sample.along < limit; });
  };
  const auto near = [&](double half) {
    return Reach{bound(along - half), bound(along + half), half};
  };
  const auto is_enough = [](const Reach& found) {
    return static_cast<std::size_t>(found.end - found.begin) >= kFewestSamples;
  };
  for (double half = smoothing_mm_; half < kWidestBridge * smoothing_mm_; half *= kWiden) {
    const Reach found = near(half);
    if (is_enough(found) && found.begin->along <= along && (found.end - 1)->along >= along) {
      return found;
    }
  }
  const Reach found = near(smoothing_mm_);
  // Beyond the last sample a quadratic runs away.
  const bool is_beside = is_enough(found) && along > found.begin->along - kStepMm &&
                         along < (found.end - 1)->along + kStepMm;
  return is_beside ? std::optional(found) : std::nullopt;
}

std::optional<SkinBorder::Place> SkinBorder::at(double along) const {
  const auto near = samples_near(along);
  if (!near) return std::nullopt;
  const auto [begin, end, half] = *near;
  Eigen::Matrix<double, 3, 2> fitted;
  double limit = 1e300;
  for (int round = 0; round < 2; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
    std::vector<double> off;
    for (auto sample = begin; sample != end; ++sample) {
      const double offset = (sample->along - along) / half;
      const Vector3d terms(1.0, offset, offset * offset);
      if (round > 0) {
        const double residual = std::abs(sample->reach - fitted.col(0).dot(terms));
        if (residual > limit) continue;
      }
      const double weight = std::pow(1.0 - offset * offset, 2) + 1e-6;
      normal += weight * terms * terms.transpose();
      right += weight * terms * Eigen::RowVector2d(sample->reach, sample->across);
    }
    fitted = normal.ldlt().solve(right);
    if (!fitted.allFinite()) return std::nullopt;
    for (auto sample = begin; sample != end; ++sample) {
      const double offset = (sample->along - along) / half;
      off.push_back(
          std::abs(sample->reach - fitted.col(0).dot(Vector3d(1.0, offset, offset * offset))));
    }
    limit = std::max(kStrayInMedians * median(std::move(off)), kStraySampleMm);
  }
  return Place{along, fitted(0, 0),
               std::clamp(fitted(0, 1), view_.across_from_mm, view_.across_to_mm),
               2.0 * fitted(2, 0) / (half * half)};
}

SkinBorder SkinBorder::smoothed_over(double smoothing_mm) const {
  SkinBorder other = *this;
  other.smoothing_mm_ = smoothing_mm;
  return other;
}

SkinBorder SkinBorder::where(const std::function<bool(const Place&)>& is_told) const {
  SkinBorder other = *this;
  std::erase_if(other.samples_, [&](const Place& sample) { return !is_told(sample); });
  return other;
}

std::optional<double> SkinBorder::reach(double along) const {
  const auto place = at(along);
  return place ? std::optional(place->reach) : std::nullopt;
}

Vector3d SkinBorder::position(const Place& place) const {
  return place.along * view_.along + place.reach * view_.outwards + place.across * view_.across;
}

std::optional<SkinBorder::Place> SkinBorder::furthest(
    double from, double to, const std::function<double(double)>& handicap) const {
  if (!(from <= to)) return std::nullopt;
  const auto weighed = [&](const Place& place) {
    return place.reach - (handicap ? handicap(place.along) : 0.0);
  };
  std::optional<Place> best;
  const auto look_at = [&](double along) {
    const auto place = at(along);
    if (place && (!best || weighed(*place) > weighed(*best))) best = place;
  };
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / kStepMm)));
  for (int i = 0; i <= steps; ++i) look_at(from + (to - from) * i / steps);
  if (!best) return std::nullopt;
  for (double step = 0.5 * kStepMm; step > kFinestStepMm; step *= 0.5) {
    const double middle = best->along;
    for (const double along : {middle - step, middle + step}) {
      if (along >= from && along <= to) look_at(along);
    }
  }
  return best;
}

}  // namespace instep
