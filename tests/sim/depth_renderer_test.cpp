#include "sim/depth_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/solids/cylinder_solid.h"
#include "sim/solids/foot_solid.h"
#include "sim/station_layout.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class Ball final : public Solid {
 public:
  explicit Ball(double radius) : radius_(radius) {}
  double value(const Vector3d& point) const override { return point.norm() - radius_; }
  Eigen::AlignedBox3d bounds() const override {
    return {Vector3d::Constant(-radius_), Vector3d::Constant(radius_)};
  }

 private:
  double radius_;
};

CameraGeometry camera_with_lens(const std::array<double, 5>& distortion) {
  LayoutSettings layout;
  layout.width_px = 160;
  layout.height_px = 120;
  layout.cameras = 5;
  // One of those that stand high enough to see the tops of solids.
  CameraGeometry camera = lay_out_station(layout).value()[2];
  camera.intrinsics.cx += 3.7;
  camera.intrinsics.fy *= 1.02;
  camera.intrinsics.distortion = distortion;
  return camera;
}

/// The lens as its formula says: from an ideal direction to a pixel.
Vector2d pixel_of(const CameraIntrinsics& lens, const Vector3d& in_camera) {
  const double x = in_camera.x() / in_camera.z();
  const double y = in_camera.y() / in_camera.z();
  const auto& [k1, k2, p1, p2, k3] = lens.distortion;
  const double r2 = x * x + y * y;
  const double radial = 1 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2;
  const double xd = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const double yd = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  return {lens.fx * xd + lens.cx, lens.fy * yd + lens.cy};
}

Vector3d point_seen(const CameraGeometry& camera, int u, int v, double depth) {
  Vector3d sight;
  EXPECT_TRUE(line_of_sight(camera.intrinsics, u, v, sight));
  return camera.station_from_camera * Vector3d(depth * sight);
}

/// Depth at which a ray meets a ball, by the quadratic formula; nothing if it misses.
std::optional<double> ball_depth(const CameraGeometry& camera, int u, int v, const Vector3d& centre,
                                 double radius) {
  Vector3d sight;
  EXPECT_TRUE(line_of_sight(camera.intrinsics, u, v, sight));
  const Vector3d c = camera.station_from_camera.inverse() * centre;
  const double a = sight.squaredNorm();
  const double b = sight.dot(c);
  const double discriminant = b * b - a * (c.squaredNorm() - radius * radius);
  if (discriminant < 0) return std::nullopt;
  return (b - std::sqrt(discriminant)) / a;
}

const std::array<double, 5> kStraight{};
const std::array<double, 5> kBarrel{-0.12, 0.03, 0.001, -0.002, 0.004};

TEST(LineOfSight, UndoesTheLensFormula) {
  const CameraGeometry camera = camera_with_lens(kBarrel);
  for (int v = 0; v < camera.intrinsics.height; v += 7) {
    for (int u = 0; u < camera.intrinsics.width; u += 7) {
      Vector3d sight;
      ASSERT_TRUE(line_of_sight(camera.intrinsics, u, v, sight));
      EXPECT_NEAR((pixel_of(camera.intrinsics, sight) - Vector2d(u, v)).norm(), 0.0, 1e-7);
    }
  }
}

class DepthOfBall : public testing::TestWithParam<std::array<double, 5>> {};

TEST_P(DepthOfBall, MatchesTheQuadraticFormula) {
  const CameraGeometry camera = camera_with_lens(GetParam());
  const Vector3d centre(15.0, -20.0, 90.0);
  Scene scene;
  scene.platform.reset();
  scene.solids.push_back({std::make_shared<Ball>(60.0)});
  scene.solids[0].station_from_solid.translation() = centre;
  const ExactView view = render_depth(scene, camera);
  int hits = 0, silhouette = 0;
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const auto pixel = static_cast<std::size_t>(v * view.width + u);
      const auto depth = ball_depth(camera, u, v, centre, 60.0);
      const auto seen = static_cast<double>(view.depth_mm[pixel]);
      if (depth.has_value() != (seen > 0)) {
        ++silhouette;  // may differ only where the ray all but misses
        const auto wider = ball_depth(camera, u, v, centre, 60.001);
        EXPECT_TRUE(wider.has_value());
        continue;
      }
      if (!depth) continue;
      ++hits;
      const Vector3d at = point_seen(camera, u, v, *depth);
      const Vector3d to_eye = (camera.station_from_camera.translation() - at).normalized();
      const double incidence = std::acos(std::min(1.0, to_eye.dot((at - centre).normalized())));
      const double allowed = 2e-4 / std::max(0.02, std::cos(incidence));
      EXPECT_NEAR(seen, *depth, allowed) << u << " " << v;
      EXPECT_NEAR(static_cast<double>(view.incidence_rad[pixel]), incidence, 2e-3);
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_LT(silhouette, 5);
}

INSTANTIATE_TEST_SUITE_P(Lenses, DepthOfBall, testing::Values(kStraight, kBarrel));

TEST(RenderDepth, PutsEveryPixelOfACylinderOnItsWallOrTop) {
  const CameraGeometry camera = camera_with_lens(kStraight);
  Scene scene;
  scene.platform.reset();
  scene.solids.push_back({std::make_shared<CylinderSolid>(40.0, 120.0)});
  const ExactView view = render_depth(scene, camera);
  int wall = 0, top = 0;
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const auto depth =
          static_cast<double>(view.depth_mm[static_cast<std::size_t>(v * view.width + u)]);
      if (depth <= 0) continue;
      const Vector3d at = point_seen(camera, u, v, depth);
      const double off_wall = std::abs(at.head<2>().norm() - 40.0);
      const double off_top = std::abs(at.z() - 120.0);
      (off_wall < off_top ? wall : top) += 1;
      EXPECT_LT(std::min(off_wall, off_top), 1e-3) << u << " " << v;
      const Vector3d to_eye = camera.station_from_camera.translation() - at;
      EXPECT_GE(to_eye.head<2>().dot(at.head<2>()), off_wall < off_top ? -1e-3 : -1e9)
          << "the near wall, not the far one";
    }
  }
  EXPECT_GT(wall, 300);
  EXPECT_GT(top, 50);
}

TEST(RenderDepth, SeesThePlatformAsFarAsItReaches) {
  const CameraGeometry camera = camera_with_lens(kBarrel);
  Scene scene;
  scene.platform = Platform{300.0, 200.0, 20.0};
  const ExactView view = render_depth(scene, camera);
  int above = 0;
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const auto pixel = static_cast<std::size_t>(v * view.width + u);
      Vector3d sight;
      ASSERT_TRUE(line_of_sight(camera.intrinsics, u, v, sight));
      const Vector3d eye = camera.station_from_camera.translation();
      const Vector3d ray = camera.station_from_camera.linear() * sight;
      const double depth = -eye.z() / ray.z();
      const Vector3d floor = eye + depth * ray;
      const bool on_top = depth > 0 && std::abs(floor.x()) < 149.9 && std::abs(floor.y()) < 99.9;
      if (!on_top) continue;
      ++above;
      EXPECT_NEAR(static_cast<double>(view.depth_mm[pixel]), depth, 1e-3);
      EXPECT_NEAR(static_cast<double>(view.incidence_rad[pixel]), std::acos(-ray.normalized().z()),
                  1e-5);
    }
  }
  EXPECT_GT(above, 500);
}

TEST(RenderDepth, PutsEveryPixelOfAFootOnItsSkin) {
  const auto foot = std::make_shared<FootSolid>(draw_foot(5, Side::kLeft));
  Scene scene;
  scene.platform.reset();
  RigidTransform placed = RigidTransform::Identity();
  placed.linear() = Eigen::AngleAxisd(0.3, Vector3d::UnitZ()).toRotationMatrix();
  placed.translation() = Vector3d(-120.0, -30.0, 0.0);
  scene.solids.push_back({foot, placed});
  const CameraGeometry camera = camera_with_lens(kBarrel);
  const ExactView view = render_depth(scene, camera);
  int hits = 0;
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const auto depth =
          static_cast<double>(view.depth_mm[static_cast<std::size_t>(v * view.width + u)]);
      if (depth <= 0) continue;
      ++hits;
      const Vector3d at = placed.inverse() * point_seen(camera, u, v, depth);
      EXPECT_NEAR(foot->value(at), 0.0, 1e-3) << u << " " << v;
    }
  }
  EXPECT_GT(hits, 2000);
}

TEST(RenderDepth, ShowsTheNearerOfTwoSolids) {
  const CameraGeometry camera = camera_with_lens(kStraight);
  const Vector3d towards = camera.station_from_camera.translation().normalized();
  Scene scene;
  scene.solids.push_back({std::make_shared<Ball>(30.0)});
  scene.solids.push_back({std::make_shared<Ball>(10.0)});
  scene.solids[0].station_from_solid.translation() = Vector3d(0, 0, 60);
  scene.solids[1].station_from_solid.translation() = Vector3d(0, 0, 60) + 100.0 * towards;
  const ExactView both = render_depth(scene, camera);
  std::swap(scene.solids[0], scene.solids[1]);
  EXPECT_EQ(render_depth(scene, camera).depth_mm, both.depth_mm);
  scene.solids.resize(1);
  const ExactView near_alone = render_depth(scene, camera);
  int seen = 0;
  for (std::size_t i = 0; i < both.depth_mm.size(); ++i) {
    if (near_alone.depth_mm[i] > 0 && near_alone.depth_mm[i] < 450) {
      ++seen;
      EXPECT_EQ(both.depth_mm[i], near_alone.depth_mm[i]);
    }
  }
  EXPECT_GT(seen, 20);
}

TEST(RenderDepth, MarksEdgesWhereDepthJumps) {
  const CameraGeometry camera = camera_with_lens(kStraight);
  Scene scene;
  scene.solids.push_back({std::make_shared<CylinderSolid>(40.0, 120.0)});
  const ExactView view = render_depth(scene, camera);
  for (int v = 1; v + 1 < view.height; ++v) {
    for (int u = 1; u + 1 < view.width; ++u) {
      const auto at = [&](int du, int dv) {
        return view.depth_mm[static_cast<std::size_t>((v + dv) * view.width + u + du)];
      };
      if (at(0, 0) <= 0) continue;
      bool jump = false;
      for (int k = 0; k < 9; ++k) jump |= std::abs(at(k % 3 - 1, k / 3 - 1) - at(0, 0)) > 10.0F;
      EXPECT_EQ(view.edge[static_cast<std::size_t>(v * view.width + u)] != 0, jump);
    }
  }
}

}  // namespace
}  // namespace instep
