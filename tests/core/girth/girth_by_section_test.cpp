#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::level_plane;

/// Adds the walls of an upright box; every face has corners of its own, as in an STL file.
void add_walls(TriangleMesh& mesh, const Vector3d& low, const Vector3d& high, int walls = 4) {
  const std::array<Vector3d, 4> feet = {
      Vector3d(low.x(), low.y(), low.z()), Vector3d(high.x(), low.y(), low.z()),
      Vector3d(high.x(), high.y(), low.z()), Vector3d(low.x(), high.y(), low.z())};
  const auto add = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto& corner : {a, b, c}) mesh.positions.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  const Vector3d up(0, 0, high.z() - low.z());
  for (std::size_t i = 0; i < static_cast<std::size_t>(walls); ++i) {
    const Vector3d& a = feet[i];
    const Vector3d& b = feet[(i + 1) % 4];
    add(a, b, b + up);
    add(a, b + up, a + up);
  }
}

TEST(GirthBySection, ChainsFacesThatShareNoCorners) {
  TriangleMesh mesh;
  add_walls(mesh, {0, 0, 0}, {30, 20, 10});
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 100, 1e-9);
  EXPECT_NEAR(girth->stretched_mm, 100, 1e-9);
  EXPECT_TRUE(girth->warnings.empty());
}

TEST(GirthBySection, CutsThroughCornersOnThePlane) {
  TriangleMesh mesh;
  add_walls(mesh, {0, 0, 0}, {30, 20, 10});
  add_walls(mesh, {0, 0, 10}, {30, 20, 25});
  const auto girth = girth_by_section(mesh, level_plane(10));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 100, 1e-9);
}

TEST(GirthBySection, ChoosesTheLargerLoopAndNamesTheOther) {
  TriangleMesh mesh;
  add_walls(mesh, {50, 0, 0}, {60, 10, 10});
  add_walls(mesh, {0, 0, 0}, {30, 20, 10});
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth);
  EXPECT_NEAR(girth->contact_mm, 100, 1e-9);
  ASSERT_EQ(girth->warnings.size(), 1U);
  EXPECT_NE(girth->warnings.front().find("40.0"), std::string::npos);
}

TEST(GirthBySection, BridgesAnOpenSectionOnlyForTheStretchedLength) {
  TriangleMesh mesh;
  add_walls(mesh, {0, 0, 0}, {30, 20, 10}, 3);
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth);
  EXPECT_NEAR(girth->stretched_mm, 100, 1e-9);
  EXPECT_NEAR(girth->contact_mm, 80, 1e-9);
  EXPECT_NEAR(girth->largest_gap_mm, 20, 1e-9);
  EXPECT_FALSE(girth->warnings.empty());
}

TEST(GirthBySection, StitchesSeams) {
  TriangleMesh mesh;
  add_walls(mesh, {0, 0, 0}, {30, 20, 10}, 2);
  TriangleMesh rest;
  add_walls(rest, {0, 0, 0}, {30, 20, 10});
  for (std::size_t i = 4; i < rest.triangles.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto corner : rest.triangles[i]) {
      mesh.positions.push_back(rest.positions[corner] + Vector3d(0, 0.1, 0));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth);
  EXPECT_NEAR(girth->contact_mm, 100.2, 1e-9);
  EXPECT_TRUE(girth->warnings.empty());
}

TEST(GirthBySection, RefusesWhatCannotBeCut) {
  TriangleMesh mesh;
  EXPECT_FALSE(girth_by_section(mesh, level_plane(4)));
  add_walls(mesh, {0, 0, 0}, {30, 20, 10});
  EXPECT_FALSE(girth_by_section(mesh, level_plane(40)));
  mesh.triangles.push_back({0, 1, 9999});
  EXPECT_FALSE(girth_by_section(mesh, level_plane(4)));
  mesh.triangles.pop_back();
  mesh.positions[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(girth_by_section(mesh, level_plane(4)));
}

}  // namespace
}  // namespace instep
