#include "core/foot/landmarks/toe_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/outline_of_borders.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 250.0;
constexpr double kFactor = full_size_factor(kLength);  // as the outline is seen
constexpr std::size_t kFewPoints = 4000;               // as of a coarse camera
const Landmark kFibulare{Vector3d(157.0, -45.0, 12.0), 0.9, ""};

/// The little toe is round, and ends in a gap, beyond which the border is the next toe's.
double lateral_border(double x) {
  constexpr double kMiddle = 198.0;
  constexpr double kRound = 9.0;
  constexpr double kEnd = 206.0;
  if (x > kEnd) return 38.0;
  const double side = 45.0 - 0.09 * (std::max(x, 157.0) - 157.0);
  const double toe = std::max(0.0, kRound * kRound - std::pow(x - kMiddle, 2));
  return std::max(x < kMiddle ? side : 0.0, 34.0 + std::sqrt(toe));
}

double bearing_deg(double x, double out) {
  return std::atan2(out - 45.0, x - kFibulare.position_mm.x()) * 180.0 / std::numbers::pi;
}

double true_bearing_deg() {
  double most = -90.0;
  for (double x = 0.70 * kLength; x <= 0.85 * kLength; x += 0.01) {
    most = std::max(most, bearing_deg(x, lateral_border(x)));
  }
  return most;
}

TEST(ToePoints, TheRulerTouchesTheLittleToeBeforeTheGap) {
  double sum = 0.0;
  constexpr int kFeet = 12;
  for (int seed = 1; seed <= kFeet; ++seed) {
    const auto outline = test::outline_with([](double) { return 45.0; }, lateral_border, kLength,
                                            0.3, static_cast<std::uint64_t>(seed), kFewPoints);
    Landmark fibulare = kFibulare;
    fibulare.position_mm *= kFactor;
    const auto found = find_toe5_contact(outline, fibulare);
    ASSERT_TRUE(found);
    const Vector3d contact = outline.in_foot_frame(*found).position_mm;
    const double off = bearing_deg(contact.x(), -contact.y()) - true_bearing_deg();
    EXPECT_NEAR(off, 0.0, 0.5) << seed;
    sum += off;
  }
  EXPECT_NEAR(sum / kFeet, 0.0, 0.1);
}

}  // namespace
}  // namespace instep
