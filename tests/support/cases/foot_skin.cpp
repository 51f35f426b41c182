#include "tests/support/cases/foot_skin.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/surface/paper/marching_cubes.h"

namespace instep::test {

using Eigen::Vector3d;

TriangleMesh rough_skin(const FootSolid& foot, double top_mm) {
  constexpr double kCubeMm = 4.0;
  Eigen::AlignedBox3d box = foot.bounds();
  box.max().z() = std::min(box.max().z(), top_mm);
  return march_cubes(CubeGrid::covering(box, kCubeMm).value(),
                     {[&](const Vector3d& place) { return -foot.value(place); },
                      [&](const Eigen::Vector3i&) { return true; },
                      {}});
}

void settle_on_skin(const FootSolid& foot, PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Vector3d& place = cloud.positions[i];
    Vector3d slope = foot.gradient(place);
    for (int step = 0; step < 20; ++step) {
      const double value = foot.value(place);
      if (std::abs(value) < 1e-7) break;
      slope = foot.gradient(place);
      place -= value / slope.squaredNorm() * slope;
    }
    cloud.normals[i] = slope.normalized();
  }
}

}  // namespace instep::test
