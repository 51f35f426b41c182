#include "core/fusion/views/seen_through.h"

#include <gtest/gtest.h>

#include "tests/support/fused_frames.h"
#include "tests/support/ray_cast_scene.h"

namespace instep {
namespace {

/// Two cameras look down on a table from two sides; the points are said to come from the first.
struct Table {
  std::vector<CameraGeometry> cameras = {
      camera_looking_at("a", {0, -400, 400}, {0, 0, 0}, 160, 120, 150),
      camera_looking_at("b", {0, 400, 400}, {0, 0, 0}, 160, 120, 150)};
  std::vector<FusedDepth> depths;
  std::vector<PosedDepth> posed;

  Table() {
    for (const auto& camera : cameras) {
      depths.push_back(*fuse_frames(
          {render(camera, {disc_surface({0, 0, 0}, {0, 0, 1}, 100)}, {1e-6, 0, 0}, 1, 0.1)}));
    }
    for (std::size_t i = 0; i < 2; ++i) {
      posed.push_back({&cameras[i].intrinsics, &depths[i], cameras[i].station_from_camera});
    }
  }

  bool keeps(const Eigen::Vector3d& point) const {
    ViewedCloud cloud;
    cloud.cloud.positions = {point};
    cloud.views = {0};
    return points_not_seen_through(cloud, posed, 4.0).size() == 1;
  }
};

TEST(PointsNotSeenThrough, KeepsSurfaceAndDropsWhatFloatsAboveIt) {
  const Table table;
  EXPECT_TRUE(table.keeps({0, 0, 0}));
  EXPECT_TRUE(table.keeps({20, -30, 2}));
  EXPECT_FALSE(table.keeps({0, 0, 15}));
  EXPECT_FALSE(table.keeps({-10, 20, 40}));
}

TEST(PointsNotSeenThrough, KeepsWhatNoOtherCameraCanJudge) {
  const Table table;
  EXPECT_TRUE(table.keeps({0, 0, -30}));    // hidden below the table
  EXPECT_TRUE(table.keeps({0, -170, 10}));  // nothing is seen behind it
  EXPECT_TRUE(table.keeps({0, 900, 400}));  // behind the other camera
}

}  // namespace
}  // namespace instep
