#include "core/surface/paper/octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;
using Members = std::vector<std::uint32_t>;

/// Points that crowd towards one corner, so that leaves differ in size.
Points crowded_points(std::size_t count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double part = random.uniform();
    points.emplace_back(50 * part * random.uniform(), 20 * part * random.uniform(),
                        30 * part * part);
  }
  return points;
}

TEST(Octree, PutsEveryPointIntoTheOneLeafThatHoldsIt) {
  const auto points = crowded_points(3000, 1);
  const Octree octree(points, 40);
  std::set<std::uint32_t> seen;
  for (std::size_t leaf = 0; leaf < octree.leaves().size(); ++leaf) {
    const auto& [box, members] = octree.leaves()[leaf];
    EXPECT_FALSE(members.empty());
    EXPECT_LE(members.size(), 40U);
    for (const auto member : members) {
      EXPECT_TRUE(seen.insert(member).second);
      EXPECT_TRUE(box.contains(points[member]));
      EXPECT_EQ(octree.leaf_at(points[member]), leaf);
    }
  }
  EXPECT_EQ(seen.size(), points.size());
}

TEST(Octree, DividesNoCubeThatDoesNotNeedIt) {
  const auto points = crowded_points(3000, 2);
  const Octree octree(points, 40);
  Eigen::AlignedBox3d all;
  for (const auto& point : points) all.extend(point);
  const double root = all.sizes().maxCoeff();
  for (const auto& [box, members] : octree.leaves()) {
    const double side = box.sizes().x();
    if (side > 0.99 * root) continue;
    // The parent of a leaf is the cube of twice the side on the same lattice.
    const Vector3d corner = all.center().array() - 0.5 * root;
    const Vector3d steps = (box.min() - corner).array() / (2.0 * side) + 1e-9;
    Eigen::AlignedBox3d parent;
    parent.min() = corner + 2.0 * side * Vector3d(steps.array().floor());
    parent.max() = parent.min() + Vector3d::Constant(2.0 * side);
    EXPECT_GT(std::count_if(points.begin(), points.end(),
                            [&](const auto& point) { return parent.contains(point); }),
              40);
  }
}

TEST(Octree, HasNoLeafInEmptyCubesNorOutside) {
  const Points points = {{0, 0, 0}, {10, 10, 10}};
  const Octree octree(points, 1);
  EXPECT_EQ(octree.leaves().size(), 2U);
  EXPECT_TRUE(octree.leaf_at({1, 1, 1}));
  EXPECT_FALSE(octree.leaf_at({9, 1, 1}));
  EXPECT_FALSE(octree.leaf_at({11, 11, 11}));
}

TEST(Octree, FindsTheNearestLeafAsBruteForceDoes) {
  const Octree octree(crowded_points(1500, 6), 30);
  test::RandomNumbers random(7);
  int beyond = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d place(random.uniform(-30, 80), random.uniform(-30, 60), random.uniform(-30, 60));
    double nearest = 1e9;
    for (const auto& leaf : octree.leaves()) {
      nearest = std::min(nearest, leaf.box.exteriorDistance(place));
    }
    const auto found = octree.nearest_leaf(place, 12.0);
    ASSERT_EQ(found.has_value(), nearest <= 12.0);
    if (!found) ++beyond;
    if (found) {
      EXPECT_EQ(octree.leaves()[*found].box.exteriorDistance(place), nearest);
    }
  }
  EXPECT_GT(beyond, 20);
  EXPECT_LT(beyond, 480);
}

TEST(Octree, EndsOnPointsThatCannotBeParted) {
  const Points points(500, Vector3d(1, 2, 3));
  const Octree octree(points, 10);
  EXPECT_EQ(octree.leaves().size(), 1U);
  Points near = {{0, 0, 0}, {1e5, 1e5, 1e5}};
  near.insert(near.end(), 500, Vector3d(3, 3, 3));
  EXPECT_EQ(Octree(near, 10).leaf_at({3, 3, 3}).has_value(), true);
}

TEST(Octree, LeavesTouchIfTheirCubesShareAPlace) {
  const Octree octree(crowded_points(1500, 3), 30);
  const auto& leaves = octree.leaves();
  for (std::size_t a = 0; a < leaves.size(); ++a) {
    const auto touching = octree.touching(a);
    for (std::size_t b = 0; b < leaves.size(); ++b) {
      const bool shares = (leaves[a].box.min().array() <= leaves[b].box.max().array()).all() &&
                          (leaves[b].box.min().array() <= leaves[a].box.max().array()).all();
      EXPECT_EQ(std::count(touching.begin(), touching.end(), b), a != b && shares ? 1 : 0);
    }
  }
}

bool at_least_ten(const Members& members) {
  return members.size() >= 10;
}

TEST(Octree, CombinesSmallLeavesWithTheirSmallestNeighbour) {
  const Octree octree(crowded_points(2000, 4), 30);
  const auto combined = combined_points(octree, 30, at_least_ten);
  ASSERT_EQ(combined.size(), octree.leaves().size());
  int small = 0;
  for (std::size_t leaf = 0; leaf < combined.size(); ++leaf) {
    const auto& own = octree.leaves()[leaf].points;
    EXPECT_TRUE(std::equal(own.begin(), own.end(), combined[leaf].begin()));
    EXPECT_GE(combined[leaf].size(), 10U);
    if (own.size() >= 10) {
      EXPECT_EQ(combined[leaf].size(), own.size());
      continue;
    }
    ++small;
    std::size_t fewest = 1000;
    for (const std::size_t other : octree.touching(leaf)) {
      fewest = std::min(fewest, octree.leaves()[other].points.size());
    }
    EXPECT_GE(combined[leaf].size(), own.size() + fewest);
    if (own.size() + fewest >= 10) {
      EXPECT_EQ(combined[leaf].size(), own.size() + fewest);
    }
    EXPECT_EQ(std::set<std::uint32_t>(combined[leaf].begin(), combined[leaf].end()).size(),
              combined[leaf].size());
  }
  EXPECT_GT(small, 3);
}

TEST(Octree, CombiningEndsWithoutNeighboursOrBeyondTheMost) {
  const Points few = {{0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(combined_points(Octree(few, 5), 5, at_least_ten)[0].size(), 2U);
  const Octree octree(crowded_points(2000, 5), 30);
  for (const auto& members : combined_points(octree, 30, [](const auto&) { return false; })) {
    EXPECT_LE(members.size(), 60U);
  }
}

}  // namespace
}  // namespace instep
