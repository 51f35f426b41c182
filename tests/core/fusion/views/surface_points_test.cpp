#include "core/fusion/views/surface_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "core/degree.h"
#include "tests/support/fused_frames.h"
#include "tests/support/ray_cast_scene.h"

namespace instep {
namespace {

struct Seen {
  CameraGeometry camera;
  FusedDepth depth;
  PointCloud cloud;  ///< station frame
};

std::vector<std::uint32_t> all_pixels(const FusedDepth& depth) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t i = 0; i < depth.depth_mm.size(); ++i) {
    if (depth.depth_mm[i] > 0.0F) pixels.push_back(i);
  }
  return pixels;
}

Seen look(CameraGeometry camera, const Surfaces& surfaces, const RenderNoise& noise, int frames,
          double unit_mm) {
  Seen seen;
  std::vector<DepthFrame> rendered;
  for (int i = 0; i < frames; ++i) {
    rendered.push_back(
        render(camera, surfaces, noise, static_cast<std::uint64_t>(i) + 10, unit_mm));
  }
  seen.camera = camera;
  seen.depth = *fuse_frames(rendered);
  drop_flying_pixels(camera.intrinsics, seen.depth);
  const auto rays = Deprojector::create(camera.intrinsics);
  seen.cloud = transformed(camera.station_from_camera,
                           surface_points(*rays, seen.depth, all_pixels(seen.depth)));
  return seen;
}

CameraGeometry side_camera() {
  auto camera = camera_looking_at("cam", {0, -480, 200}, {0, 0, 40}, 320, 240, 290);
  camera.intrinsics.distortion = {-0.2, 0.05, 0.001, -0.002, 0.0};
  return camera;
}

Surfaces sphere() {
  return {ellipsoid_surface({0, 0, 40}, {60, 60, 60})};
}

TEST(SurfacePoints, LieOnASphereWithItsNormals) {
  const auto seen = look(side_camera(), sphere(), {}, 1, 0.01);
  ASSERT_GT(seen.cloud.size(), 1500U);
  EXPECT_TRUE(check_cloud(seen.cloud));
  double sum = 0;
  for (std::size_t i = 0; i < seen.cloud.size(); ++i) {
    ASSERT_NEAR(sphere()[0]->distance(seen.cloud.positions[i]), 0.0, 0.02);
    const auto truth = sphere()[0]->normal(seen.cloud.positions[i]);
    const double turn = std::acos(std::min(1.0, seen.cloud.normals[i].dot(truth))) / kDegree;
    ASSERT_LT(turn, 6.0);
    sum += turn;
    const Eigen::Vector3d view =
        seen.camera.station_from_camera.translation() - seen.cloud.positions[i];
    ASSERT_NEAR(seen.cloud.view_directions[i].dot(view.normalized()), 1.0, 1e-6);
  }
  EXPECT_LT(sum / static_cast<double>(seen.cloud.size()), 0.5);
}

TEST(SurfacePoints, CarryATrueSigmaAlongTheNormal) {
  for (const int frames : {1, 15}) {
    const auto seen = look(side_camera(), sphere(), {2.9e-6, 0, 0}, frames, 1.0);
    double sum = 0;
    double turn = 0;
    for (std::size_t i = 0; i < seen.cloud.size(); ++i) {
      const auto& point = seen.cloud.positions[i];
      sum += std::pow(sphere()[0]->distance(point) / seen.cloud.sigma_mm[i], 2);
      turn += std::acos(std::min(1.0, seen.cloud.normals[i].dot(sphere()[0]->normal(point))));
    }
    const auto count = static_cast<double>(seen.cloud.size());
    EXPECT_GT(std::sqrt(sum / count), 0.7) << frames;
    EXPECT_LT(std::sqrt(sum / count), 1.4) << frames;
    EXPECT_LT(turn / count / kDegree, 6.0) << frames;
  }
}

TEST(SurfacePoints, AreFreeOfPointsThatFloatAtSilhouettes) {
  Surfaces scene = sphere();
  scene.push_back(disc_surface({0, 300, 0}, {0, -1, 0.2}, 900));
  const auto seen = look(side_camera(), scene, {1e-6, 0.8, 0.01}, 5, 0.1);
  std::size_t on_sphere = 0;
  for (const auto& point : seen.cloud.positions) {
    const double away =
        std::min(std::abs(scene[0]->distance(point)), std::abs(scene[1]->distance(point)));
    ASSERT_LT(away, 2.5);
    on_sphere += std::abs(scene[0]->distance(point)) < 2.5 ? 1U : 0U;
  }
  EXPECT_GT(on_sphere, 1500U);
}

TEST(SurfacePoints, LeaveOutWhatIsSeenTooSlantwise) {
  // A floor that runs away from a low camera is seen at 70 to 85 degrees.
  const auto camera = camera_looking_at("cam", {0, -500, 120}, {0, 0, 0}, 320, 240, 290);
  const auto seen = look(camera, {disc_surface({0, 0, 0}, {0, 0, 1}, 900)}, {}, 1, 0.01);
  ASSERT_GT(seen.cloud.size(), 100U);
  for (std::size_t i = 0; i < seen.cloud.size(); ++i) {
    ASSERT_GT(seen.cloud.view_directions[i].z(), std::cos(75.5 * kDegree));
  }
}

TEST(SurfacePoints, KeepASurfaceWithScatteredHoles) {
  const auto whole = look(side_camera(), sphere(), {}, 1, 0.1);
  const auto holed = look(side_camera(), sphere(), {0, 0, 0.05}, 1, 0.1);
  EXPECT_GT(holed.cloud.size(), whole.cloud.size() * 85 / 100);
}

TEST(SurfacePoints, BearPixelsWithoutNeighboursAndAbsurdDepths) {
  FusedDepth depth;
  depth.width = 320;
  depth.height = 240;
  depth.depth_mm.assign(320 * 240, 0.0F);
  depth.sigma_mm.assign(320 * 240, 1.0F);
  const auto rays = Deprojector::create(side_camera().intrinsics);
  EXPECT_TRUE(surface_points(*rays, depth, {5000}).empty());
  depth.depth_mm[5000] = 500.0F;
  EXPECT_TRUE(surface_points(*rays, depth, {5000}).empty());
  depth.depth_mm.assign(320 * 240, std::numeric_limits<float>::max());
  drop_flying_pixels(rays->intrinsics(), depth);
  const auto cloud = surface_points(*rays, depth, {5000, 6000});
  EXPECT_TRUE(cloud.is_consistent());
}

}  // namespace
}  // namespace instep
