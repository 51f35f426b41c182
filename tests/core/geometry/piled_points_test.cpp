#include "core/geometry/piled_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Counts = std::vector<std::size_t>;
using Places = std::vector<Eigen::Vector3d>;

Counts and_one_of(Counts counts, std::size_t count) {
  counts.push_back(count);
  return counts;
}

TEST(PiledPoints, AreWhereACellHoldsManyTimesWhatOthersDo) {
  const Counts even(1000, 3);
  EXPECT_EQ(usual_beside_piles(even), std::nullopt);
  EXPECT_EQ(usual_beside_piles(and_one_of(even, 20)), std::nullopt);
  EXPECT_EQ(usual_beside_piles(and_one_of(even, 30)), 3U);
  EXPECT_EQ(usual_beside_piles({}), std::nullopt);
}

TEST(PiledPoints, AreNotTheSkinAmidStrays) {
  Counts counts(1000, 1);
  counts.resize(2000, 12);
  EXPECT_EQ(usual_beside_piles(counts), std::nullopt);
}

TEST(PiledPoints, LeaveTheUsualNumberInEachCell) {
  test::RandomNumbers random(4);
  Places places;
  for (int i = 0; i < 2000; ++i) {
    const double reach = i < 1000 ? 5.0 : 0.6;
    places.emplace_back(random.uniform(-reach, reach), random.uniform(-reach, reach),
                        random.uniform(-0.5, 0.5));
  }
  constexpr double kSide = 0.5;
  constexpr std::size_t kUsual = 4;
  std::map<std::tuple<double, double, double>, std::pair<std::size_t, std::size_t>> cells;
  const auto piled = piled_points(places, kSide, kUsual);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Array3d cell = (places[i].array() / kSide).floor();
    auto& [all, staying] = cells[{cell.x(), cell.y(), cell.z()}];
    ++all;
    if (!piled[i]) ++staying;
  }
  for (const auto& [cell, counts] : cells) {
    EXPECT_EQ(counts.second, std::min(counts.first, kUsual));
  }
  EXPECT_GT(std::count(piled.begin(), piled.end(), true), 500);
}

}  // namespace
}  // namespace instep
