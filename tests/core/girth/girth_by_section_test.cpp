#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>

#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

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

TEST(GirthBySection, ChoosesTheLoopThatTheControlPointsLieOn) {
  TriangleMesh mesh;
  add_walls(mesh, {0, 0, 0}, {30, 20, 10});
  add_walls(mesh, {50, 0, 0}, {60, 10, 10});
  const auto girth =
      girth_by_section(mesh, *TapePlane::through({50, 5, 4}, {60, 5, 4}, {55, 10, 4}));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 40, 1e-9);
  ASSERT_EQ(girth->warnings.size(), 1U);
  EXPECT_NE(girth->warnings.front().find("100.0"), std::string::npos) << girth->warnings.front();
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

/// Two shells of a box with slits between their ends.
TEST(GirthBySection, TellsTheWidestGapBetweenPiecesOfAnOpenSection) {
  TriangleMesh mesh;
  add_walls(mesh, {0, 0, 0}, {30, 20, 10}, 1);
  add_walls(mesh, {5, 12, 0}, {25, 20, 10}, 1);
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 50, 1e-9);
  EXPECT_NEAR(girth->largest_gap_mm, 13, 1e-9);
}

/// A strip of a wall is longer than the body's own loop.
TEST(GirthBySection, ChoosesTheLoopBesideALongerOpenPiece) {
  TriangleMesh mesh;
  add_walls(mesh, {0, 0, 0}, {30, 20, 10});
  add_walls(mesh, {-100, -30, 0}, {200, -10, 10}, 1);
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 100, 1e-9);
  EXPECT_NEAR(girth->stretched_mm, 100, 1e-9);
  ASSERT_EQ(girth->warnings.size(), 1U);
  EXPECT_NE(girth->warnings.front().find("open"), std::string::npos);
}

/// The gaps of what does not count are no gaps of the girth.
/// Straight walls whose corners are missing, each of which goes round nothing.
TEST(GirthBySection, ChoosesABodyInPiecesBeforeALoopWithin) {
  TriangleMesh mesh;
  for (const double y : {0.0, 60.0}) add_walls(mesh, {12, y, 0}, {88, y, 10}, 1);
  for (const double x : {0.0, 100.0}) add_walls(mesh, {x, 12, 0}, {x, 48, 10}, 2);
  add_walls(mesh, {50, 30, 0}, {55, 35, 10});
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->stretched_mm, 2.0 * 76.0 + 2.0 * 36.0 + 4.0 * std::hypot(12.0, 12.0), 1e-9);
  EXPECT_NEAR(girth->largest_gap_mm, std::hypot(12.0, 12.0), 1e-9);
}

/// A tile further from the next than from its own other end was the girth: 4 mm of 251.
TEST(GirthBySection, DoesNotCloseATileOnItself) {
  TriangleMesh mesh;
  constexpr int kTiles = 60;
  const double step = 2.0 * std::numbers::pi / kTiles;
  const auto corner = [](double angle, double z) {
    return Vector3d(40.0 * std::cos(angle), 40.0 * std::sin(angle), z);
  };
  for (int i = 0; i < kTiles; ++i) {
    for (const double from : {0.0, 0.225}) {
      const double a = (i + from) * step;
      const double b = (i + from + 0.225) * step;
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const auto& place : {corner(a, 0), corner(b, 0), corner(b, 10), corner(a, 10)}) {
        mesh.positions.push_back(place);
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->stretched_mm, test::kCylinderGirth, 1.0);
  EXPECT_NEAR(girth->largest_gap_mm, 80.0 * std::sin(0.275 * step), 1e-3);
}

/// Fragments in the hole of an open section do not make it narrower than what is between them.
TEST(GirthBySection, TellsTheGapBetweenFragmentsInAHole) {
  TriangleMesh mesh;
  add_walls(mesh, {0, 0, 0}, {100, 60, 10}, 3);
  for (const double y : {6.0, 54.0}) add_walls(mesh, {-5, y, 0}, {5, y, 10}, 1);
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->largest_gap_mm, 48.0, 1e-9);
}

TEST(GirthBySection, TellsNoSeamOfAnotherLoop) {
  TriangleMesh mesh;
  add_walls(mesh, {0, 0, 0}, {30, 20, 10});
  add_walls(mesh, {40, 0, 0}, {50, 10, 10}, 3);
  const auto wall = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& corner :
       {Vector3d(40, 10, 0), Vector3d(40, 2, 0), Vector3d(40, 2, 10), Vector3d(40, 10, 10)}) {
    mesh.positions.push_back(corner);
  }
  mesh.triangles.push_back({wall, wall + 1, wall + 2});
  mesh.triangles.push_back({wall, wall + 2, wall + 3});
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_EQ(girth->largest_gap_mm, 0.0);
  ASSERT_EQ(girth->warnings.size(), 1U);
  EXPECT_NE(girth->warnings.front().find("another closed loop, 40.0 mm"), std::string::npos);
}

/// As exported by a program that rounds the corners of each face on its own. Each seam was sought
/// among all ends anew: 4,000 faces took 149 s.
TEST(GirthBySection, StitchesThousandsOfFacesWhoseCornersHardlyMeet) {
  constexpr int kFaces = 20000;
  test::RandomNumbers random(1);
  TriangleMesh mesh;
  const auto corner = [&](double turn, double z) {
    const double angle = 2.0 * std::numbers::pi * turn / (kFaces / 2);
    const double hair = 1e-6;
    mesh.positions.emplace_back(40.0 * std::cos(angle) + random.uniform(-hair, hair),
                                40.0 * std::sin(angle) + random.uniform(-hair, hair), z);
  };
  for (int i = 0; i < kFaces / 2; ++i) {
    for (const int upper : {0, 1}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      corner(i, 0.0);
      corner(i + 1, upper == 0 ? 0.0 : 10.0);
      corner(upper == 0 ? i + 1 : i, 10.0);
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  const auto girth = girth_by_section(mesh, level_plane(4));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->stretched_mm, test::kCylinderGirth, 1e-3);
  EXPECT_LT(girth->largest_gap_mm, 1e-5);
  EXPECT_TRUE(girth->warnings.empty());
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
