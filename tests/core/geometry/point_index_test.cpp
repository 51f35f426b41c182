#include "core/geometry/point_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace instep {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> random_points(std::size_t count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-10, 10);
  std::vector<Vector3d> points(count);
  for (auto& point : points) point = {uniform(random), uniform(random), uniform(random)};
  return points;
}

std::vector<std::size_t> by_brute_force(const std::vector<Vector3d>& points,
                                        const Vector3d& query) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return (points[a] - query).squaredNorm() < (points[b] - query).squaredNorm();
  });
  return order;
}

TEST(PointIndex, FindsTheSameNearestAsBruteForce) {
  const auto points = random_points(700);
  const PointIndex index(points);
  for (const auto& query : random_points(20)) {
    const auto expected = by_brute_force(points, query);
    const auto found = index.nearest(query, 25);
    ASSERT_EQ(found.size(), 25U);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].index, expected[i]);
  }
}

TEST(PointIndex, FindsAllWithinARadiusAndThoseOnIt) {
  const std::vector<Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2.5, 0, 0}};
  const PointIndex index(points);
  const auto found = index.within({0, 0, 0}, 2.0);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[2].index, 2U);
}

TEST(PointIndex, OrdersDuplicatesByIndex) {
  const std::vector<Vector3d> points(1000, Vector3d(1, 2, 3));
  const PointIndex index(points);
  const auto found = index.within({1, 2, 3}, 0.1);
  ASSERT_EQ(found.size(), 1000U);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].index, i);
}

TEST(PointIndex, FindsTheNearestInACrowdAtOnePlaceWithoutSearchingItAll) {
  // Whole searches for each of 200,000 points would take minutes.
  std::vector<Vector3d> points(200000, Vector3d(1, 2, 3));
  points.emplace_back(1, 2, 3.5);
  const PointIndex index(points);
  for (const auto& point : points) {
    const auto found = index.nearest(point, 9);
    ASSERT_EQ(found.size(), 9U);
    ASSERT_EQ(found.front().squared_distance, 0.0);
  }
  const auto beside = index.nearest({1, 2, 4}, 2);
  EXPECT_EQ(beside.front().index, 200000U);
  EXPECT_EQ(beside.back().squared_distance, 1.0);
}

TEST(PointIndex, AnswersOnNoPoints) {
  const std::vector<Vector3d> none;
  const PointIndex index(none);
  EXPECT_TRUE(index.nearest({0, 0, 0}, 3).empty());
  EXPECT_TRUE(index.within({0, 0, 0}, 3).empty());
}

}  // namespace
}  // namespace instep
