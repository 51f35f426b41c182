#include "core/mean.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Place {
  Vector3d position;
};

TEST(Mean, IsThatOfNumbersAndOfVectors) {
  EXPECT_EQ(mean_of(std::vector<double>{1.0, 2.0, 6.0}), 3.0);
  EXPECT_EQ(mean_of(std::vector<Vector2d>{{1.0, 2.0}, {3.0, 5.0}}), Vector2d(2.0, 3.5));
}

TEST(Mean, IsOfWhatIsMadeOfEachItem) {
  const std::vector<Place> places = {{{1.0, 2.0, 3.0}}, {{3.0, 4.0, 7.0}}};
  EXPECT_EQ(mean_of(places, &Place::position), Vector3d(2.0, 3.0, 5.0));
  EXPECT_EQ(mean_of(places, [](const Place& place) { return place.position.z(); }), 5.0);
}

TEST(Mean, IsZeroOfNone) {
  EXPECT_EQ(mean_of(std::vector<double>{}), 0.0);
  EXPECT_EQ(mean_of(std::vector<Vector3d>{}), Vector3d(0.0, 0.0, 0.0));
}

TEST(Mean, IsSummedInTheOrderOfTheItems) {
  EXPECT_EQ(mean_of(std::vector<double>{1e17, 1.0, -1e17}), 0.0);
  EXPECT_EQ(mean_of(std::vector<double>{1e17, -1e17, 3.0}), 1.0);
}

}  // namespace
}  // namespace instep
