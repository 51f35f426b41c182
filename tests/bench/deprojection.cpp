// Prints the median time of making the rays of a 640x480 camera, once for its life.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "core/fusion/frames/deprojector.h"

namespace {

void time_rays(const char* name, const instep::CameraIntrinsics& lens) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> times;
  for (int i = 0; i < 31; ++i) {
    const auto start = Clock::now();
    if (!instep::Deprojector::create(lens)) return;
    times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  std::printf("rays %s distortion: median %.2f ms, worst %.2f ms\n", name, times[times.size() / 2],
              times.back());
}

}  // namespace

int main() {
  instep::CameraIntrinsics lens;
  lens.width = 640;
  lens.height = 480;
  lens.fx = lens.fy = 575.8;
  lens.cx = 319.5;
  lens.cy = 239.5;
  time_rays("without", lens);
  lens.distortion = {-0.2, 0.05, 0.001, -0.001, 0.0};
  time_rays("with", lens);
}
