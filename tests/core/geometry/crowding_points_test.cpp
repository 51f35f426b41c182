#include "core/geometry/crowding_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Places = std::vector<Eigen::Vector3d>;

/// In the order of their first coordinate, one of them at the origin, from which cells count.
Places random_places(std::size_t count) {
  test::RandomNumbers random(1);
  Places places = {Eigen::Vector3d::Zero()};
  while (places.size() < count) {
    places.emplace_back(random.uniform(0.0, 5.0), random.uniform(0.0, 5.0),
                        random.uniform(0.0, 1.0));
  }
  std::sort(places.begin(), places.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x(); });
  return places;
}

TEST(CrowdingPoints, AreAllOfACellButTheOneNearestToItsMiddle) {
  constexpr double kSide = 0.4;
  const Places places = random_places(3000);
  std::map<std::tuple<double, double, double>, std::pair<double, std::size_t>> nearest;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Array3d cell = (places[i].array() / kSide).floor();
    const double off = (places[i].array() - kSide * (cell + 0.5)).matrix().norm();
    auto [found, added] = nearest.try_emplace({cell.x(), cell.y(), cell.z()}, off, i);
    if (off < found->second.first) found->second = {off, i};
  }
  std::vector<bool> expected(places.size(), true);
  for (const auto& [cell, one] : nearest) expected[one.second] = false;
  EXPECT_EQ(crowding_points(places, kSide), expected);
  EXPECT_GT(std::count(expected.begin(), expected.end(), true), 2000);
}

TEST(CrowdingPoints, AreNoneWherePointsStandApart) {
  Places places;
  for (int i = 0; i < 100; ++i) places.emplace_back(i / 10 * 2.0, i % 10 * 2.0, 1e6 * (i % 3));
  EXPECT_EQ(crowding_points(places, 1.0), std::vector<bool>(100, false));
}

TEST(CrowdingPoints, AreAllButTheFirstOfThoseAtOnePlace) {
  EXPECT_EQ(crowding_points(Places(4, {1.0, 2.0, 3.0}), 0.5),
            (std::vector<bool>{false, true, true, true}));
  EXPECT_TRUE(crowding_points({}, 1.0).empty());
}

}  // namespace
}  // namespace instep
