#include "tests/bench/scaling/timed_girth.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "tests/bench/scaling/peak_memory.h"

namespace instep::bench {
namespace {

double milliseconds_of(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

}  // namespace

double median_milliseconds(const std::function<void()>& work) {
  constexpr std::size_t kFewestRuns = 3;
  constexpr std::size_t kMostRuns = 7;
  constexpr double kEnoughMilliseconds = 2000.0;
  std::vector<double> runs;
  double sum = 0.0;
  while (runs.size() < kFewestRuns || (runs.size() < kMostRuns && sum < kEnoughMilliseconds)) {
    runs.push_back(milliseconds_of(work));
    sum += runs.back();
  }
  std::sort(runs.begin(), runs.end());
  return runs[runs.size() / 2];
}

TimedGirth timed(const GirthMethod& method, const PointCloud& cloud, const TapePlane& plane) {
  TimedGirth timed;
  timed.points = cloud.size();
  {
    const PeakMemory memory;
    const auto girth = method(cloud, plane);
    const auto cloud_bytes = static_cast<double>(cloud.size() * sizeof(Eigen::Vector3d));
    timed.peak_clouds = 1.0 + static_cast<double>(memory.bytes_more()) / cloud_bytes;
    if (girth) {
      timed.band_points = girth->band_points;
      timed.stretched_mm = girth->stretched_mm;
    }
  }
  timed.milliseconds = median_milliseconds([&] { (void)method(cloud, plane); });
  return timed;
}

double growth_exponent(const std::vector<TimedGirth>& girths) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  const auto place = [](const TimedGirth& girth) {
    return Eigen::Vector2d(std::log(static_cast<double>(girth.points)),
                           std::log(girth.milliseconds));
  };
  for (const auto& girth : girths) mean += place(girth) / static_cast<double>(girths.size());
  double square = 0.0;
  double product = 0.0;
  for (const auto& girth : girths) {
    const Eigen::Vector2d offset = place(girth) - mean;
    square += offset.x() * offset.x();
    product += offset.x() * offset.y();
  }
  return product / square;
}

}  // namespace instep::bench
