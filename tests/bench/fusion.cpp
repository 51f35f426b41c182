// Prints the time of each stage from frames to clouds: 4 cameras x 15 frames of 640x480.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <vector>

#include "core/fusion/fuse_views.h"
#include "tests/support/ray_cast_scene.h"

namespace {

using namespace instep;
using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

Surfaces standing_person() {
  return {ellipsoid_surface({0, 55, 28}, {125, 45, 34}, 3),
          ellipsoid_surface({4, -50, 28}, {120, 44, 33}, -3),
          cylinder_surface({-55, 55}, 33, 30, 500), cylinder_surface({-50, -50}, 33, 30, 500),
          disc_surface({0, 0, 0}, {0, 0, 1}, 350)};
}

void time_fusion(const char* name, const std::vector<View>& views, const FusionSettings& settings) {
  const std::clock_t busy = std::clock();
  const auto start = Clock::now();
  const auto scene = fuse_views(views, settings);
  const double elapsed = milliseconds_since(start);
  const double cpu = 1000.0 * static_cast<double>(std::clock() - busy) / CLOCKS_PER_SEC;
  if (!scene) {
    std::printf("%s: %s\n", name, scene.error().line().c_str());
    return;
  }
  std::printf("%-44s %8.1f ms  (%.1f of CPU; %zu feet, %zu points)\n", name, elapsed, cpu,
              scene->feet.size(), scene->feet.front().size() + scene->feet.back().size());
}

}  // namespace

int main() {
  const auto scene = standing_person();
  std::vector<View> views;
  double adding = 0.0;
  double finishing = 0.0;
  for (const auto& camera : ring_of_cameras(4, 450, 330, {0, 0, 20})) {
    TemporalFusion fusion;
    for (std::uint64_t i = 0; i < 15; ++i) {
      const auto frame = render(camera, scene, {1.4e-6, 0.7, 0.01}, views.size() * 100 + i + 1);
      const auto start = Clock::now();
      if (!fusion.add(frame)) return 1;
      adding += milliseconds_since(start);
    }
    const auto start = Clock::now();
    auto depth = fusion.result();
    finishing += milliseconds_since(start);
    if (!depth) return 1;
    views.push_back({camera, std::move(*depth), nullptr});
  }
  std::printf("%-44s %8.1f ms\n", "taking in a frame, mean", adding / 60.0);
  std::printf("%-44s %8.1f ms\n", "fused depth after the last frame, per camera", finishing / 4.0);

  const auto start = Clock::now();
  for (auto& view : views) {
    auto rays = Deprojector::create(view.geometry.intrinsics);
    if (!rays) return 1;
    view.rays = std::make_shared<const Deprojector>(std::move(*rays));
  }
  std::printf("%-44s %8.1f ms\n", "ray tables, once a camera", milliseconds_since(start) / 4.0);
  FusionSettings settings;
  settings.platform_height_mm = 0.0;
  settings.refine_views = false;
  time_fusion("views to feet, calibrated", views, settings);
  time_fusion("views to feet, calibrated, again", views, settings);
  settings.refine_views = true;
  time_fusion("views to feet, refining poses", views, settings);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%-44s %8.1f MB\n", "peak memory", static_cast<double>(usage.ru_maxrss) / 1024.0);
}
