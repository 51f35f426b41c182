#include "core/girth/contour/contour_turns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A closed curve by its parameter from 0 to a full turn, counter-clockwise, in `count` corners.
Contour corners_of(const std::function<Vector2d(double)>& curve, int count) {
  Contour contour;
  for (int i = 0; i < count; ++i) {
    const double at = kTurn * i / count;
    const Vector2d along = curve(at + 1e-6) - curve(at - 1e-6);
    contour.points.push_back(curve(at));
    contour.outward.push_back(Vector2d(along.y(), -along.x()).normalized());
  }
  return contour;
}

Contour ellipse(double a, double b, int count) {
  return corners_of([=](double at) { return Vector2d(a * std::cos(at), b * std::sin(at)); }, count);
}

/// Three lobes, with hollows between them that a tape bridges.
Contour lobed(int count) {
  const auto curve = [](double at) -> Vector2d {
    return (1.0 + 0.2 * std::cos(3.0 * at)) * Vector2d(std::cos(at), std::sin(at));
  };
  return corners_of(curve, count);
}

double sum(const std::vector<double>& turns) {
  return std::accumulate(turns.begin(), turns.end(), 0.0);
}

TEST(ContourTurns, AreOneFullTurnRoundAConvexContour) {
  for (const auto& contour :
       {ellipse(1, 1, 200), ellipse(1, 1, 7), ellipse(0.45, 0.2, 151), ellipse(0.02, 0.4, 300)}) {
    const auto turns = turns_of(contour);
    ASSERT_EQ(turns.contact.size(), contour.points.size());
    ASSERT_EQ(turns.stretched.size(), contour.points.size());
    EXPECT_NEAR(sum(turns.contact), kTurn, 1e-9);
    EXPECT_NEAR(sum(turns.stretched), kTurn, 1e-9);
  }
}

/// A circle turns by equal parts.
TEST(ContourTurns, AreSharedByTheCornersOfACircle) {
  const auto turns = turns_of(ellipse(3, 3, 90));
  for (std::size_t i = 0; i < 90; ++i) {
    EXPECT_NEAR(turns.contact[i], kTurn / 90, 1e-9);
    EXPECT_NEAR(turns.stretched[i], kTurn / 90, 1e-9);
  }
}

/// Half of the way to each neighbour belongs to a corner, however unequal the two are.
TEST(ContourTurns, AreSharedHalfAndHalfBetweenUnequalNeighbours) {
  const std::vector<double> angles = {0.0, 0.1, 0.4, 1.2, 1.3, 2.9, 3.5, 4.0, 5.5, 6.1};
  Contour contour;
  for (const double angle : angles) {
    contour.outward.emplace_back(std::cos(angle), std::sin(angle));
    contour.points.push_back(0.3 * contour.outward.back());
  }
  const auto turns = turns_of(contour);
  const std::size_t count = angles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double before = angles[(i + count - 1) % count] - (i == 0 ? kTurn : 0.0);
    const double after = angles[(i + 1) % count] + (i + 1 == count ? kTurn : 0.0);
    EXPECT_NEAR(turns.contact[i], 0.5 * (after - before), 1e-12) << "corner " << i;
    EXPECT_NEAR(turns.stretched[i], 0.5 * (after - before), 1e-12) << "corner " << i;
  }
}

/// A tape turns at a corner by the angle of all directions in which no corner is further out.
TEST(ContourTurns, OfATapeAreTheDirectionsInWhichACornerIsOutermost) {
  constexpr int kDirections = 20000;
  const Contour contour = lobed(120);
  std::vector<double> expected(contour.points.size(), 0.0);
  for (int k = 0; k < kDirections; ++k) {
    const double angle = kTurn * (k + 0.5) / kDirections;
    const Vector2d direction(std::cos(angle), std::sin(angle));
    std::size_t outermost = 0;
    for (std::size_t i = 1; i < contour.points.size(); ++i) {
      if (direction.dot(contour.points[i]) > direction.dot(contour.points[outermost])) {
        outermost = i;
      }
    }
    expected[outermost] += kTurn / kDirections;
  }
  const auto turns = turns_of(contour);
  int bridged = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(turns.stretched[i], expected[i], 1.01 * kTurn / kDirections) << "corner " << i;
    if (expected[i] > 0.0) continue;
    EXPECT_EQ(turns.stretched[i], 0.0) << "corner " << i;
    ++bridged;
  }
  EXPECT_GT(bridged, 30);
}

TEST(ContourTurns, OfTheLineTurnBackInAHollowWhereThoseOfTheTapeVanish) {
  const auto turns = turns_of(lobed(360));
  EXPECT_NEAR(sum(turns.contact), kTurn, 1e-9);
  EXPECT_NEAR(sum(turns.stretched), kTurn, 1e-9);
  for (const std::size_t hollow : {60U, 180U, 300U}) {
    EXPECT_LT(turns.contact[hollow], 0.0);
    EXPECT_EQ(turns.stretched[hollow], 0.0);
  }
  for (const std::size_t lobe : {0U, 120U, 240U}) {
    EXPECT_GT(turns.contact[lobe], 0.0);
    EXPECT_NEAR(turns.stretched[lobe], turns.contact[lobe], 1e-3 * turns.contact[lobe]);
  }
}

Contour moved(Contour contour, const std::function<double(std::size_t)>& outwards) {
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    contour.points[i] += outwards(i) * contour.outward[i];
  }
  return contour;
}

TEST(ContourTurns, TellWhatACircleGainsFromBeingMovedOutwards) {
  constexpr int kCount = 400;
  const Contour circle = ellipse(2, 2, kCount);
  const auto turns = turns_of(circle);
  for (const double move : {-0.3, 0.001, 0.5}) {
    const Contour larger = moved(circle, [=](std::size_t) { return move; });
    const double gain = perimeter(larger.points) - perimeter(circle.points);
    EXPECT_NEAR(sum(turns.contact) * move, gain, 1e-4 * std::abs(gain));
    EXPECT_NEAR(sum(turns.stretched) * move, gain, 1e-4 * std::abs(gain));
  }
}

/// Moves that vary slowly round the line, too small to lift a corner off or onto the tape.
TEST(ContourTurns, TellWhatBothLengthsGainWhereCornersMoveUnequally) {
  const auto outwards = [](std::size_t i) {
    return 1e-7 * (1.0 + std::sin(0.01 * static_cast<double>(i)));
  };
  for (const auto& contour : {ellipse(0.5, 0.3, 600), lobed(600)}) {
    const auto turns = turns_of(contour);
    double contact = 0.0;
    double stretched = 0.0;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      contact += turns.contact[i] * outwards(i);
      stretched += turns.stretched[i] * outwards(i);
    }
    const Contour larger = moved(contour, outwards);
    EXPECT_NEAR(perimeter(larger.points) - perimeter(contour.points), contact, 1e-3 * contact);
    EXPECT_NEAR(perimeter(convex_hull(larger.points)) - perimeter(convex_hull(contour.points)),
                stretched, 1e-2 * stretched);
  }
}

/// As many waves round a circle, so deep from top to bottom.
Contour waved(int waves, double depth) {
  const auto curve = [=](double at) -> Vector2d {
    return (1.0 + 0.5 * depth * std::cos(waves * at)) * Vector2d(std::cos(at), std::sin(at));
  };
  return corners_of(curve, 200 * waves);
}

double fold_depth_of(const Contour& contour) {
  return mean_fold_depth(contour, contour.length() - contour.tape_length());
}

TEST(MeanFoldDepth, IsThatOfTheWavesHoweverManyThereAre) {
  for (const int waves : {40, 80}) {
    for (const double depth : {0.2, 0.4}) {
      EXPECT_NEAR(fold_depth_of(waved(waves, depth)), depth, 0.35 * depth) << waves;
    }
  }
}

TEST(MeanFoldDepth, IsNoneOfAContourWithoutHollows) {
  EXPECT_NEAR(fold_depth_of(ellipse(0.5, 0.3, 600)), 0.0, 1e-3);
}

}  // namespace
}  // namespace instep
