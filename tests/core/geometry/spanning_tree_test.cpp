#include "core/geometry/spanning_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// Lengths of a minimum spanning tree by Prim's method over all pairs, ascending.
std::vector<double> lengths_by_prim(const Points& points) {
  std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> joined(points.size(), false);
  std::vector<double> lengths;
  std::size_t latest = 0;
  for (std::size_t step = 1; step < points.size(); ++step) {
    joined[latest] = true;
    std::size_t next = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (joined[i]) continue;
      nearest[i] = std::min(nearest[i], (points[i] - points[latest]).norm());
      if (next == points.size() || nearest[i] < nearest[next]) next = i;
    }
    lengths.push_back(nearest[next]);
    latest = next;
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

void expect_minimum_tree(const Points& points) {
  const auto tree = minimum_spanning_tree(points);
  const auto expected = lengths_by_prim(points);
  ASSERT_EQ(tree.size(), expected.size());
  std::vector<std::size_t> part(points.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  for (std::size_t i = 0; i < tree.size(); ++i) {
    EXPECT_NEAR(tree[i].length, expected[i], 1e-12 * (1.0 + expected[i]));
    EXPECT_NEAR(tree[i].length, (points[tree[i].from] - points[tree[i].to]).norm(), 1e-12);
    const std::size_t from = part[tree[i].from];
    const std::size_t to = part[tree[i].to];
    EXPECT_NE(from, to) << "the edges form a ring";
    std::replace(part.begin(), part.end(), from, to);
  }
}

Points random_points(std::size_t count, std::uint64_t seed, const Vector3d& size,
                     const Vector3d& corner = Vector3d::Zero()) {
  test::RandomNumbers random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(corner + Vector3d(random.uniform() * size.x(), random.uniform() * size.y(),
                                          random.uniform() * size.z()));
  }
  return points;
}

TEST(SpanningTree, MatchesPrimOnRandomPoints) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    expect_minimum_tree(random_points(400, seed, {10, 10, 10}));
    expect_minimum_tree(random_points(400, seed, {10, 10, 0}));
    expect_minimum_tree(random_points(100, seed, {10, 0, 0}));
  }
}

TEST(SpanningTree, JoinsScatteredHeaps) {
  Points points;
  test::RandomNumbers random(8);
  for (std::uint64_t heap = 0; heap < 12; ++heap) {
    const Vector3d corner(random.uniform(0, 500), random.uniform(0, 500), random.uniform(0, 500));
    for (const auto& point : random_points(20 + 5 * heap, heap, {3, 3, 3}, corner)) {
      points.push_back(point);
    }
  }
  points.emplace_back(4000, 0, 0);
  expect_minimum_tree(points);
}

TEST(SpanningTree, MatchesPrimOnAGridWithManyEqualDistances) {
  Points points;
  for (int i = 0; i < 12; ++i) {
    for (int k = 0; k < 9; ++k) points.emplace_back(2.0 * i, 3.0 * k, 0.0);
  }
  expect_minimum_tree(points);
}

TEST(SpanningTree, TakesDuplicatesAtNoDistance) {
  auto points = random_points(50, 3, {5, 5, 5});
  points.insert(points.end(), 30, points.front());
  expect_minimum_tree(points);
  EXPECT_EQ(minimum_spanning_tree(points).front().length, 0.0);
}

TEST(SpanningTree, OfOnePointOrNoneHasNoEdges) {
  EXPECT_TRUE(minimum_spanning_tree({}).empty());
  EXPECT_TRUE(minimum_spanning_tree({{1, 2, 3}}).empty());
  ASSERT_EQ(minimum_spanning_tree({{0, 0, 0}, {3, 4, 0}}).size(), 1U);
  EXPECT_EQ(minimum_spanning_tree({{0, 0, 0}, {3, 4, 0}}).front().length, 5.0);
}

}  // namespace
}  // namespace instep
