#include "core/surface/noise/asked_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace instep {
namespace {

using Eigen::Vector3d;

/// Points of a circle, so many per radian up to a turn and from there on, in their order.
PointIndex circle(int first, double until, int then) {
  std::vector<Vector3d> points;
  const auto arc = [&](double from, double to, int per_radian) {
    const int count = static_cast<int>(std::lround((to - from) * per_radian));
    for (int i = 0; i < count; ++i) {
      const double turn = from + (to - from) * i / count;
      points.emplace_back(std::cos(turn), std::sin(turn), 0.0);
    }
  };
  arc(0.0, until, first);
  arc(until, 2.0 * std::numbers::pi, then);
  return PointIndex(std::move(points));
}

std::vector<std::size_t> all_of(const PointIndex& index) {
  std::vector<std::size_t> places(index.points().size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  return places;
}

std::vector<std::size_t> points_of(const std::vector<AskedPlace>& asked) {
  std::vector<std::size_t> points;
  for (const auto& one : asked) points.push_back(one.point);
  return points;
}

double turn_of(const PointIndex& index, std::size_t place) {
  const Vector3d& point = index.points()[place];
  return std::atan2(point.y(), point.x());
}

TEST(AskedPlaces, AreFewAndEvenOfAnEvenRow) {
  for (const int per_radian : {20, 33, 100, 1000}) {
    const auto index = circle(per_radian, 1.0, per_radian);
    const auto asked = points_of(asked_places(index, all_of(index)));
    EXPECT_GE(asked.size(), 24U);
    EXPECT_LE(asked.size(), 48U);
    EXPECT_TRUE(std::is_sorted(asked.begin(), asked.end()));
    for (std::size_t i = 1; i < asked.size(); ++i) {
      EXPECT_EQ(asked[i] - asked[i - 1], asked[1] - asked[0]) << per_radian;
    }
  }
}

TEST(AskedPlaces, AreAllOfFew) {
  const auto index = circle(3, 1.0, 3);
  EXPECT_EQ(points_of(asked_places(index, all_of(index))), all_of(index));
  EXPECT_TRUE(asked_places(index, {}).empty());
  EXPECT_EQ(points_of(asked_places(index, {4})), std::vector<std::size_t>{4});
}

/// A dense part had as large a share of them as of the points.
TEST(AskedPlaces, AreOfEachPartAsItIsLong) {
  for (const double until : {1.5, 2.0, 3.0}) {
    const auto index = circle(500, until, 100);
    const auto asked = points_of(asked_places(index, all_of(index)));
    const auto dense = std::count_if(asked.begin(), asked.end(), [&](std::size_t place) {
      return turn_of(index, place) >= 0.0 && turn_of(index, place) < until;
    });
    const double share = static_cast<double>(dense) / static_cast<double>(asked.size());
    EXPECT_NEAR(share, 0.5 * until / std::numbers::pi, 0.06) << until;
    EXPECT_EQ(std::set<std::size_t>(asked.begin(), asked.end()).size(), asked.size());
  }
}

/// So what is usual among those that were not put between stays usual among the points.
TEST(AskedPlaces, ThatAreNotBetweenAreOfEachPartAsItHasPoints) {
  const auto index = circle(500, 3.0, 100);
  const auto asked = asked_places(index, all_of(index));
  int dense = 0;
  int sparse = 0;
  for (const auto& one : asked) {
    const double turn = turn_of(index, one.point);
    if (one.between) {
      EXPECT_TRUE(turn > 2.9 || turn < 0.1) << turn;
    } else {
      ++(turn >= 0.0 && turn < 3.0 ? dense : sparse);
    }
  }
  const double points = 500.0 * 3.0 + 100.0 * (2.0 * std::numbers::pi - 3.0);
  EXPECT_NEAR(dense / static_cast<double>(dense + sparse), 1500.0 / points, 0.05);
}

TEST(AskedPlaces, LieInTheOrderOfThePlacesAcrossTheirEnd) {
  auto places = all_of(circle(500, 3.0, 100));
  const auto index = circle(500, 3.0, 100);
  // So that the sparse part lies across the end.
  std::rotate(places.begin(), places.begin() + 600, places.end());
  const auto asked = points_of(asked_places(index, places));
  double way = 0.0;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto& next = index.points()[asked[(i + 1) % asked.size()]];
    way += (next - index.points()[asked[i]]).norm();
  }
  EXPECT_NEAR(way, 2.0 * std::numbers::pi, 0.1);
}

/// Beside a hole all points between its borders lie at one of them.
TEST(AskedPlaces, AreNotCrowdedBesideAHole) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 2000; ++i) {
    const double turn = 5.0 * i / 2000;
    points.emplace_back(std::cos(turn), std::sin(turn), 0.0);
  }
  const PointIndex index(std::move(points));
  const auto asked = asked_places(index, all_of(index));
  const double way = 5.0 / static_cast<double>(asked.size());
  for (std::size_t i = 1; i < asked.size(); ++i) {
    const auto& one = index.points()[asked[i].point];
    EXPECT_GT((one - index.points()[asked[i - 1].point]).norm(), 0.4 * way) << i;
  }
}

TEST(AskedPlaces, AreNotManyWhateverThePoints) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 4000; ++i) {
    points.emplace_back(i % 200 < 110 ? 1e-9 * i : 1e6 * (i % 7), 0.0, 0.0);
  }
  const PointIndex index(std::move(points));
  EXPECT_LT(asked_places(index, all_of(index)).size(), 4U * 48U);
}

}  // namespace
}  // namespace instep
