#include "core/geometry/cell_crowds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
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

TEST(CellCrowds, LeaveTheOneNearestToTheMiddleOfItsCell) {
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
  const auto crowds = crowds_in_cells(places, kSide);
  EXPECT_EQ(crowds.crowding, expected);
  EXPECT_EQ(crowds.counts.size(), nearest.size());
  EXPECT_EQ(std::accumulate(crowds.counts.begin(), crowds.counts.end(), std::size_t{0}),
            places.size());
  EXPECT_GT(std::count(expected.begin(), expected.end(), true), 2000);
}

TEST(CellCrowds, AreNoneWherePointsStandApart) {
  Places places;
  for (int i = 0; i < 100; ++i) places.emplace_back(i / 10 * 2.0, i % 10 * 2.0, 1e6 * (i % 3));
  const auto crowds = crowds_in_cells(places, 1.0);
  EXPECT_EQ(crowds.crowding, std::vector<bool>(100, false));
  EXPECT_EQ(crowds.counts, std::vector<std::size_t>(100, 1));
}

TEST(CellCrowds, LeaveTheFirstOfThoseAtOnePlace) {
  const auto crowds = crowds_in_cells(Places(4, {1.0, 2.0, 3.0}), 0.5);
  EXPECT_EQ(crowds.crowding, (std::vector<bool>{false, true, true, true}));
  EXPECT_EQ(crowds.counts, (std::vector<std::size_t>{4}));
  EXPECT_TRUE(crowds_in_cells({}, 1.0).crowding.empty());
}

TEST(CellCrowds, HaveAPileWhereACellHoldsManyTimesWhatOthersDo) {
  CellCrowds crowds{{}, std::vector<std::size_t>(1000, 3)};
  EXPECT_FALSE(crowds.has_pile());
  crowds.counts.push_back(24);
  EXPECT_FALSE(crowds.has_pile());
  crowds.counts.push_back(25);
  EXPECT_TRUE(crowds.has_pile());
  EXPECT_FALSE(CellCrowds{}.has_pile());
}

}  // namespace
}  // namespace instep
