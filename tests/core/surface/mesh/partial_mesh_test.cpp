#include "core/surface/mesh/partial_mesh.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

using Eigen::Vector3d;

/// A hexagon of side 1 round corner 0, and a few places more.
class PartialMeshOfHexagon : public ::testing::Test {
 protected:
  static std::vector<Vector3d> places() {
    const double h = 0.8660254037844386;
    return {{0, 0, 0},     {1, 0, 0},    {0.5, h, 0},   {-0.5, h, 0},    {-1, 0, 0},
            {-0.5, -h, 0}, {0.5, -h, 0}, {0.5, 0.3, 0}, {0.5, 0.3, 3.0}, {2, 0.1, 0}};
  }

  std::vector<Vector3d> points_ = places();
  std::vector<PartialMesh::Corner> all_ = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  PartialMesh mesh_{points_};
};

TEST_F(PartialMeshOfHexagon, TakesTrianglesRoundACornerUntilItIsSurrounded) {
  for (PartialMesh::Corner k = 1; k <= 6; ++k) {
    EXPECT_FALSE(mesh_.is_surrounded(0));
    const PartialMesh::Triangle triangle{0, k, k % 6 + 1};
    ASSERT_TRUE(mesh_.accepts(triangle, all_)) << k;
    mesh_.add(triangle);
  }
  EXPECT_TRUE(mesh_.is_surrounded(0));
  EXPECT_FALSE(mesh_.is_surrounded(1));
  EXPECT_TRUE(mesh_.has_edge(1, 2));
  EXPECT_FALSE(mesh_.has_edge(2, 1));
  EXPECT_EQ(mesh_.triangles().size(), 6U);
}

TEST_F(PartialMeshOfHexagon, KnowsAHoleOfThreeEdges) {
  mesh_.add({2, 1, 9});
  mesh_.add({0, 2, 3});
  EXPECT_FALSE(mesh_.is_hole({0, 1, 2}));
  mesh_.add({1, 0, 6});
  EXPECT_TRUE(mesh_.is_hole({0, 1, 2}));
  mesh_.add({0, 1, 2});
  EXPECT_FALSE(mesh_.is_hole({0, 1, 2}));
}

TEST_F(PartialMeshOfHexagon, RefusesAnEdgeTwiceInTheSameDirection) {
  mesh_.add({0, 1, 2});
  EXPECT_FALSE(mesh_.accepts({0, 1, 2}, all_));
  EXPECT_FALSE(mesh_.accepts({0, 1, 9}, all_));
  EXPECT_TRUE(mesh_.accepts({2, 1, 9}, all_));
}

TEST_F(PartialMeshOfHexagon, RefusesToFoldBackOverItself) {
  mesh_.add({0, 1, 2});
  EXPECT_FALSE(mesh_.accepts({1, 0, 3}, all_)) << "wound the other way and on the same side";
  EXPECT_TRUE(mesh_.accepts({1, 0, 6}, all_));
}

TEST_F(PartialMeshOfHexagon, RefusesOverlapRoundACorner) {
  mesh_.add({0, 1, 3});
  EXPECT_FALSE(mesh_.accepts({0, 2, 4}, all_));
  EXPECT_TRUE(mesh_.accepts({0, 3, 4}, all_));
}

TEST_F(PartialMeshOfHexagon, RefusesToCoverACornerOnTheSameSheetOnly) {
  const std::vector<Vector3d> apart = {{0, 0, 0},     {1, 0, 0},     {0.5, 1, 0},   {0.5, 0.3, 0},
                                       {0.6, 0.3, 0}, {0.5, 0.4, 0}, {5, 0, 0},     {6, 0, 0},
                                       {5.5, 1, 0},   {5.5, 0.3, 3}, {5.6, 0.3, 3}, {5.5, 0.4, 3}};
  PartialMesh mesh(apart);
  mesh.add({3, 4, 5});
  mesh.add({9, 10, 11});
  EXPECT_FALSE(mesh.accepts({0, 1, 2}, {3, 4, 5}));
  EXPECT_TRUE(mesh.accepts({6, 7, 8}, {9, 10, 11}));
}

TEST_F(PartialMeshOfHexagon, RefusesToCrossTheBorder) {
  const std::vector<Vector3d> crossing = {{0, 0, 0},  {4, 0, 0},  {2, 1, 0},
                                          {1, -1, 0}, {3, -1, 0}, {2, 5, 0}};
  PartialMesh mesh(crossing);
  mesh.add({0, 1, 2});
  EXPECT_FALSE(mesh.accepts({3, 4, 5}, {0, 1, 2}));
}

}  // namespace
}  // namespace instep
