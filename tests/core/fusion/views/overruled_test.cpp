#include "core/fusion/views/overruled.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/fusion/views/surface_points.h"
#include "tests/support/fused_frames.h"
#include "tests/support/ray_cast_scene.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// A ball of 60 mm radius seen by four cameras. One of them may be made to err.
struct SeenBall {
  std::shared_ptr<const AnalyticSurface> ball = ellipsoid_surface({0, 0, 0}, {60, 60, 60});
  std::vector<CameraGeometry> cameras = ring_of_cameras(4, 400, 250, {0, 0, 0});
  std::vector<FusedDepth> depths;
  std::vector<PointCloud> clouds;
  std::vector<SeenSurface> surfaces;

  /// `error`: of the first camera's depth, by the distance of a pixel from the middle of the image.
  explicit SeenBall(const std::function<double(double)>& error) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      depths.push_back(*fuse_frames({render(cameras[i], {ball}, {1e-6, 0, 0}, i + 1, 0.1)}));
      if (i == 0) disturb(depths[0], error);
    }
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      std::vector<std::uint32_t> pixels;
      for (std::size_t pixel = 0; pixel < depths[i].depth_mm.size(); ++pixel) {
        if (depths[i].depth_mm[pixel] > 0.0F) pixels.push_back(static_cast<std::uint32_t>(pixel));
      }
      const auto rays = Deprojector::create(cameras[i].intrinsics);
      clouds.push_back(
          transformed(cameras[i].station_from_camera, surface_points(*rays, depths[i], pixels)));
    }
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      surfaces.push_back(seen_surface(
          {&cameras[i].intrinsics, &depths[i], cameras[i].station_from_camera}, clouds[i]));
    }
  }

  static void disturb(FusedDepth& depth, const std::function<double(double)>& error) {
    for (int v = 0; v < depth.height; ++v) {
      for (int u = 0; u < depth.width; ++u) {
        auto& z = depth.depth_mm[static_cast<std::size_t>(v * depth.width + u)];
        const double away = std::hypot(u - 0.5 * depth.width, v - 0.5 * depth.height);
        if (z > 0.0F) z += static_cast<float>(error(away));
      }
    }
  }

  std::vector<std::size_t> kept(std::size_t view) const {
    return points_not_overruled(surfaces, view);
  }
};

TEST(PointsNotOverruled, KeepsViewsThatAgree) {
  const SeenBall seen([](double) { return 0.0; });
  for (std::size_t view = 0; view < 4; ++view) {
    EXPECT_GT(static_cast<double>(seen.kept(view).size()),
              0.99 * static_cast<double>(seen.clouds[view].size()));
  }
}

TEST(PointsNotOverruled, DropsTheTailThatOneViewDrawsOutAtItsSilhouette) {
  // The ball's radius is some 73 pixels. The outer eight bend towards the camera by up to 16 mm.
  const SeenBall seen(
      [](double away) { return away > 65.0 ? -0.25 * std::pow(away - 65.0, 2) : 0.0; });
  const auto kept = seen.kept(0);
  const auto worst = [&](const std::vector<std::size_t>& points) {
    double most = 0.0;
    for (const std::size_t i : points) {
      // Lower down no second camera sees the ball better than this one; the top lies on all rims.
      const Vector3d& place = seen.clouds[0].positions[i];
      const bool judged = place.z() > 20.0 && place.z() < 50.0;
      if (judged) most = std::max(most, seen.ball->distance(place));
    }
    return most;
  };
  std::vector<std::size_t> all(seen.clouds[0].size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  EXPECT_GT(worst(all), 4.0);
  EXPECT_LT(worst(kept), 2.5);
  EXPECT_LT(kept.size(), all.size());
  for (std::size_t view = 1; view < 4; ++view) {
    EXPECT_GT(static_cast<double>(seen.kept(view).size()),
              0.97 * static_cast<double>(seen.clouds[view].size()));
  }
}

TEST(PointsNotOverruled, LetsNoPlaceGoUnseen) {
  // All of one view lies 4 mm too near: one of two sheets must stay everywhere.
  const SeenBall seen([](double) { return -4.0; });
  std::vector<Vector3d> left;
  for (std::size_t view = 0; view < 4; ++view) {
    for (const std::size_t i : seen.kept(view)) left.push_back(seen.clouds[view].positions[i]);
  }
  for (std::size_t view = 0; view < 4; ++view) {
    for (std::size_t i = 0; i < seen.clouds[view].size(); i += 97) {
      const Vector3d& place = seen.clouds[view].positions[i];
      EXPECT_TRUE(std::any_of(left.begin(), left.end(),
                              [&](const Vector3d& other) { return (other - place).norm() < 6.0; }))
          << view << ": " << place.transpose();
    }
  }
}

TEST(PointsNotOverruled, KeepsASingleView) {
  const SeenBall seen([](double) { return 0.0; });
  const std::vector<SeenSurface> alone = {seen.surfaces[0]};
  EXPECT_EQ(points_not_overruled(alone, 0).size(), seen.clouds[0].size());
}

}  // namespace
}  // namespace instep
