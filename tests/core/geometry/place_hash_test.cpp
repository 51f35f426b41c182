#include "core/geometry/place_hash.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/picked.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> in_a_box(std::size_t count) {
  test::RandomNumbers random(5);
  std::vector<Vector3d> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.emplace_back(random.uniform(0.0, 250.0), random.uniform(-50.0, 50.0),
                        random.uniform(0.0, 90.0));
  }
  return places;
}

TEST(PlaceHash, ChoosesTheSamePlacesInWhateverOrderTheyCome) {
  const auto places = in_a_box(3000);
  const auto some = picked(places, some_by_place(places, 700));
  ASSERT_EQ(some.size(), 700U);
  const std::vector<Vector3d> reversed(places.rbegin(), places.rend());
  EXPECT_EQ(picked(reversed, some_by_place(reversed, 700)), some);
}

TEST(PlaceHash, ChoosesEvenly) {
  const auto places = in_a_box(20000);
  for (const int axis : {0, 1, 2}) {
    double all = 0.0;
    double chosen = 0.0;
    for (const auto& place : places) all += place(axis) / 20000.0;
    for (const std::size_t i : some_by_place(places, 5000)) chosen += places[i](axis) / 5000.0;
    EXPECT_NEAR(chosen, all, 3.0) << axis;
  }
}

TEST(PlaceHash, ChoosesAllOfFew) {
  auto some = some_by_place(in_a_box(40), 700);
  std::sort(some.begin(), some.end());
  ASSERT_EQ(some.size(), 40U);
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i], i);
  EXPECT_TRUE(some_by_place({}, 5).empty());
}

TEST(PlaceHash, DoesNotMindTheLastBits) {
  const Vector3d place(12.3456, -7.0004, 0.0);
  EXPECT_EQ(hash_of_place(place), hash_of_place(place + Vector3d::Constant(1e-9)));
  EXPECT_NE(hash_of_place(place), hash_of_place(place + Vector3d(0.001, 0.0, 0.0)));
}

}  // namespace
}  // namespace instep
