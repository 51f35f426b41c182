#include "core/fusion/frames/deprojector.h"

#include <gtest/gtest.h>

#include "core/fusion/frames/lens.h"
#include "tests/support/ray_cast_scene.h"

namespace instep {
namespace {

CameraGeometry distorted_camera() {
  auto camera = camera_looking_at("cam", {0, 0, 500}, {0, 0, 0}, 320, 240, 280);
  camera.intrinsics.cx += 7.3;
  camera.intrinsics.fy *= 1.01;
  camera.intrinsics.distortion = {-0.28, 0.09, 0.002, -0.003, -0.01};
  return camera;
}

TEST(WidenedLens, MakesEveryRayLeanAsMuchMore) {
  const auto lens = distorted_camera().intrinsics;
  const double factor = 1.01;
  const auto narrow = Deprojector::create(lens);
  const auto wide = Deprojector::create(widened(lens, factor));
  ASSERT_TRUE(narrow && wide);
  const auto pixels = static_cast<std::size_t>(lens.width) * static_cast<std::size_t>(lens.height);
  for (std::size_t pixel = 0; pixel < pixels; pixel += 7) {
    EXPECT_NEAR(wide->ray(pixel).x(), factor * narrow->ray(pixel).x(), 1e-6);
    EXPECT_NEAR(wide->ray(pixel).y(), factor * narrow->ray(pixel).y(), 1e-6);
  }
}

TEST(Deprojector, PutsThePixelsOfAPlaneOnThePlane) {
  auto camera = distorted_camera();
  camera.station_from_camera.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()));
  const Surfaces plane = {disc_surface({0, 0, 0}, {0, 0, 1}, 2000)};
  const auto frame = render(camera, plane, {}, 1, 0.01);
  const auto deprojector = Deprojector::create(camera.intrinsics);
  ASSERT_TRUE(deprojector);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < frame.raw.size(); ++i) {
    if (frame.raw[i] == 0 || frame.raw[i] == 65535) continue;
    const Eigen::Vector3f in_camera = 0.01F * frame.raw[i] * deprojector->ray(i);
    const Eigen::Vector3d point = camera.station_from_camera * in_camera.cast<double>();
    ASSERT_NEAR(point.z(), 0.0, 0.01);
    ++seen;
  }
  EXPECT_GT(seen, frame.raw.size() / 2);
}

TEST(Deprojector, InvertsTheProjectionOfEveryPixel) {
  const auto lens = distorted_camera().intrinsics;
  const auto deprojector = Deprojector::create(lens);
  ASSERT_TRUE(deprojector);
  for (int v = 0; v < lens.height; v += 7) {
    for (int u = 0; u < lens.width; u += 7) {
      const auto ray = deprojector->ray(static_cast<std::size_t>(v * lens.width + u));
      const auto pixel = pixel_of(lens, 700.0 * ray.cast<double>());
      ASSERT_NEAR(pixel.x(), u, 1e-4);
      ASSERT_NEAR(pixel.y(), v, 1e-4);
    }
  }
}

TEST(Deprojector, RefusesALensThatIsNotSound) {
  auto lens = distorted_camera().intrinsics;
  lens.fx = 0.0;
  EXPECT_FALSE(Deprojector::create(lens));
}

TEST(Lens, JacobianIsTheSlopeOfTheDistortion) {
  const auto lens = distorted_camera().intrinsics;
  const double step = 1e-6;
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0, 0), {0.3, -0.2}, {-0.5, 0.4}}) {
    const auto jacobian = distortion_jacobian(lens, at);
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d move = step * Eigen::Vector2d::Unit(axis);
      const Eigen::Vector2d slope =
          (distorted(lens, at + move) - distorted(lens, at - move)) / (2 * step);
      EXPECT_NEAR((slope - jacobian.col(axis)).norm(), 0.0, 1e-8);
    }
  }
}

}  // namespace
}  // namespace instep
