#include "core/girth/band/section_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Places = std::vector<Eigen::Vector3d>;
using test::RandomNumbers;

constexpr double kHeight = 4.0;
constexpr double kStep = 1.0 / 1024.0;

/// Of an ellipse round a middle, from `half_turn` to each side of the first axis.
void add_ring(std::size_t count, const Eigen::Vector2d& middle, double half_turn,
              RandomNumbers& random, Places& places) {
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = random.uniform(-half_turn, half_turn);
    places.emplace_back(middle.x() + 60.0 * std::cos(turn), middle.y() + 30.0 * std::sin(turn),
                        random.uniform(-0.5, 0.5) * kHeight);
  }
}

void add_strays(std::size_t count, double furthest, RandomNumbers& random, Places& places) {
  for (std::size_t i = 0; i < count; ++i) {
    places.emplace_back(random.uniform(-furthest, furthest), random.uniform(-furthest, furthest),
                        random.uniform(-0.5, 0.5) * kHeight);
  }
}

Eigen::AlignedBox2d box_of(Places places) {
  for (auto& place : places) place = (place / kStep).array().round() * kStep;
  std::sort(places.begin(), places.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x(); });
  return section_box(places, kHeight, kStep, [&](double) { return places; });
}

void expect_round_ellipse(const Eigen::AlignedBox2d& box) {
  EXPECT_NEAR(box.sizes().x(), 120.0, 1.0);
  EXPECT_NEAR(box.sizes().y(), 60.0, 1.0);
  EXPECT_LT(box.center().norm(), 1.0);
}

TEST(SectionBox, IsRoundAllPointsOfABody) {
  RandomNumbers random(1);
  for (const std::size_t count : {24U, 200U, 5000U}) {
    Places places;
    add_ring(count, {0.0, 0.0}, std::numbers::pi, random, places);
    const auto box = box_of(places);
    for (const auto& place : places) {
      EXPECT_LT(box.exteriorDistance(place.head<2>().eval()), 2.0 * kStep);
    }
  }
}

TEST(SectionBox, IsNotRoundStraysFarOff) {
  for (const std::size_t strays : {1U, 20U, 200U}) {
    for (const double furthest : {200.0, 3000.0}) {
      RandomNumbers random(2);
      Places places;
      add_ring(2000, {0.0, 0.0}, std::numbers::pi, random, places);
      add_strays(strays, furthest, random, places);
      const auto box = box_of(places);
      // Next to the skin one may hang together with it.
      EXPECT_LT(box.diagonal().norm(), 200.0) << strays << " " << furthest;
      EXPECT_GT(box.diagonal().norm(), 134.0 - 2.0) << strays << " " << furthest;
    }
  }
}

TEST(SectionBox, IsRoundASecondBodyBesideTheFirst) {
  RandomNumbers random(3);
  Places places;
  add_ring(2000, {0.0, 0.0}, std::numbers::pi, random, places);
  add_ring(500, {150.0, 0.0}, std::numbers::pi, random, places);
  add_strays(50, 600.0, random, places);
  const auto box = box_of(places);
  EXPECT_NEAR(box.sizes().x(), 270.0, 15.0);
}

/// Ninety-nine of a hundred points lie on a twentieth of the section.
TEST(SectionBox, IsRoundTheSparseRestOfABodyThatIsDenseInAPart) {
  RandomNumbers random(4);
  Places places;
  add_ring(400, {0.0, 0.0}, std::numbers::pi, random, places);
  add_ring(40000, {0.0, 0.0}, 0.15, random, places);
  add_strays(10, 500.0, random, places);
  // A stray in a direction without points of the skin may count, up to twice as far as these.
  EXPECT_GT(box_of(places).diagonal().norm(), 132.0);
  EXPECT_LT(box_of(places).diagonal().norm(), 250.0);
}

TEST(SectionBox, IsRoundABodyOfWhichASpotWasSeenAgainAndAgain) {
  RandomNumbers random(5);
  Places places;
  add_ring(200, {0.0, 0.0}, std::numbers::pi, random, places);
  const Eigen::Vector3d spot = places.front();
  for (int i = 0; i < 8000; ++i) {
    places.push_back(spot +
                     0.1 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
  }
  expect_round_ellipse(box_of(places));
}

}  // namespace
}  // namespace instep
