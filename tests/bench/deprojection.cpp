// Prints the median time of turning one 640x480 depth image into points.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "core/fusion/deprojector.h"

int main() {
  using Clock = std::chrono::steady_clock;
  instep::CameraIntrinsics lens;
  lens.width = 640;
  lens.height = 480;
  lens.fx = lens.fy = 575.8;
  lens.cx = 319.5;
  lens.cy = 239.5;
  lens.distortion = {-0.2, 0.05, 0.001, -0.001, 0.0};
  const auto milliseconds = [](Clock::duration time) {
    return std::chrono::duration<double, std::milli>(time).count();
  };
  const auto begin = Clock::now();
  const auto deprojector = instep::Deprojector::create(lens);
  if (!deprojector) return 1;
  std::printf("ray table, once a camera: %.2f ms\n", milliseconds(Clock::now() - begin));

  std::vector<float> depth(640 * 480);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = 500.0F + static_cast<float>(i % 97);
  std::vector<Eigen::Vector3f> points;
  std::vector<double> times;
  for (int i = 0; i < 301; ++i) {
    const auto start = Clock::now();
    deprojector->deproject(depth, points);
    times.push_back(milliseconds(Clock::now() - start));
  }
  std::sort(times.begin(), times.end());
  std::printf("deprojection of 640x480: median %.3f ms, worst %.3f ms (aim: under 2 ms)\n",
              times[times.size() / 2], times.back());
}
