#include "core/surface/paper/marching_cubes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

bool every_cube(const Vector3i&) {
  return true;
}

Eigen::AlignedBox3d box_of(double half) {
  return {Vector3d::Constant(-half), Vector3d::Constant(half)};
}

/// How often each edge is walked in its direction, less how often in the other.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> walked_edges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& corners : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto from = corners[i];
      const auto to = corners[(i + 1) % 3];
      edges[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  return edges;
}

bool is_closed(const TriangleMesh& mesh) {
  for (const auto& [edge, balance] : walked_edges(mesh)) {
    if (balance != 0) return false;
  }
  return !mesh.empty();
}

double volume(const TriangleMesh& mesh) {
  double six_times = 0.0;
  for (const auto& corners : mesh.triangles) {
    six_times += mesh.positions[corners[0]].dot(
        mesh.positions[corners[1]].cross(mesh.positions[corners[2]]));
  }
  return six_times / 6.0;
}

std::optional<double> ball(const Vector3d& place) {
  return 10.0 - place.norm();
}

TEST(MarchingCubes, GiveABallItsVolumeAndRadiusWoundFromOutside) {
  for (const double cube : {2.0, 1.0, 0.5}) {
    const auto mesh = march_cubes(*CubeGrid::covering(box_of(10.5), cube), {ball, every_cube, {}});
    EXPECT_TRUE(is_closed(mesh));
    // A chord of length c lies up to c^2 / 8r inside; c is at most the diagonal of a cube.
    const double deepest = 3.0 * cube * cube / 80.0;
    EXPECT_NEAR(volume(mesh), 4000.0 / 3.0 * std::numbers::pi, deepest * 400.0 * std::numbers::pi);
    for (const auto& position : mesh.positions) {
      EXPECT_NEAR(position.norm(), 10.0, cube * cube / 80.0);
    }
  }
}

TEST(MarchingCubes, CloseTheSurfaceOfARandomField) {
  test::RandomNumbers random(3);
  const auto noise = [&](const Vector3d& place) -> std::optional<double> {
    return place.cwiseAbs().maxCoeff() > 5.0 ? -1.0 : random.normal();
  };
  const auto mesh = march_cubes(*CubeGrid::covering(box_of(8.0), 1.0), {noise, every_cube, {}});
  EXPECT_GT(mesh.triangles.size(), 500U);
  EXPECT_TRUE(is_closed(mesh));
}

TEST(MarchingCubes, TakeAValueOfZeroForInside) {
  const auto slab = [](const Vector3d& place) -> std::optional<double> {
    return place.cwiseAbs().maxCoeff() > 2.6 ? -1.0 : 0.0;
  };
  EXPECT_TRUE(
      is_closed(march_cubes(*CubeGrid::covering(box_of(4.0), 1.0), {slab, every_cube, {}})));
}

TEST(MarchingCubes, LeaveOutCubesThatAreNotAdmittedOrNotKnown) {
  const auto grid = CubeGrid::covering(box_of(10.5), 1.0);
  const auto half_known = [](const Vector3d& place) {
    return place.x() > 0.0 ? ball(place) : std::nullopt;
  };
  const auto upper = [&](const Vector3i& cube) { return grid->middle(cube).z() > 0.0; };
  for (const auto& position : march_cubes(*grid, {half_known, every_cube, {}}).positions) {
    EXPECT_GT(position.x(), 0.0);
  }
  const auto mesh = march_cubes(*grid, {ball, upper, {}});
  EXPECT_FALSE(mesh.empty());
  for (const auto& position : mesh.positions) EXPECT_GT(position.z(), -0.51);
}

TEST(MarchingCubes, TellHowMuchIsDone) {
  double last = 0.0;
  march_cubes(*CubeGrid::covering(box_of(10.5), 3.0), {ball, every_cube, [&](double done) {
                                                         EXPECT_GT(done, last);
                                                         last = done;
                                                       }});
  EXPECT_EQ(last, 1.0);
}

TEST(CubeGrid, CoversTheBoxAndRefusesCubesThatAreTooSmall) {
  const auto grid = CubeGrid::covering({Vector3d(1, 2, 3), Vector3d(4, 2, 8)}, 0.7);
  ASSERT_TRUE(grid);
  EXPECT_TRUE((grid->corner(Vector3i::Zero()).array() < Vector3d(1, 2, 3).array()).all());
  EXPECT_TRUE((grid->corner(grid->counts).array() > Vector3d(4, 2, 8).array()).all());
  for (const double cube : {1e-3, 0.0, -1.0, std::nan("")}) {
    const auto refused = CubeGrid::covering(box_of(100.0), cube);
    ASSERT_FALSE(refused) << cube;
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidInput);
  }
}

}  // namespace
}  // namespace instep
