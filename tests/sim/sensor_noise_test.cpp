#include "sim/sensor_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace instep {
namespace {

/// A wall square to the line of sight, without edges.
ExactView wall(double depth_mm, double incidence_deg = 0.0, int side = 400) {
  ExactView view{side, side, {}, {}, {}};
  const auto pixels = static_cast<std::size_t>(side * side);
  view.depth_mm.assign(pixels, static_cast<float>(depth_mm));
  view.incidence_rad.assign(pixels, static_cast<float>(incidence_deg * std::numbers::pi / 180));
  view.edge.assign(pixels, 0);
  return view;
}

struct Statistics {
  double mean = 0.0;
  double sd = 0.0;
  double share_lost = 0.0;
};

Statistics statistics_of(const std::vector<std::uint16_t>& raw, double unit_mm) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const auto value : raw) {
    if (value == 0) continue;
    sum += value * unit_mm;
    squares += value * unit_mm * value * unit_mm;
    ++count;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean),
          1.0 - count / static_cast<double>(raw.size())};
}

TEST(SensorNoise, WithoutNoiseOnlyRounds) {
  const NoiseSettings none = NoiseSettings::for_law(NoiseLaw::kNone);
  const auto raw = noisy_frame(wall(512.34, 85.0), none, 9);
  for (const auto value : raw) ASSERT_EQ(value, 5123);
}

TEST(SensorNoise, TypicalSpreadFollowsTheQuadraticLaw) {
  for (const double depth : {400.0, 500.0, 800.0}) {
    const auto seen = statistics_of(noisy_frame(wall(depth), {}, 3), 0.1);
    const double sigma = 1.425e-3 * (depth / 1000) * (depth / 1000) * 1000;
    EXPECT_NEAR(seen.sd, std::hypot(sigma, 0.1 / std::sqrt(12.0)), 0.01 * sigma) << depth;
    EXPECT_NEAR(seen.mean, depth, 0.01);
    EXPECT_NEAR(seen.share_lost, 0.005, 0.001);
  }
}

TEST(SensorNoise, PessimisticSpreadGrowsWithIncidence) {
  const NoiseSettings settings = NoiseSettings::for_law(NoiseLaw::kPessimistic);
  for (const double degrees : {0.0, 30.0, 60.0, 70.0}) {
    const auto seen = statistics_of(noisy_frame(wall(500.0, degrees), settings, 3), 0.1);
    const double theta = degrees * std::numbers::pi / 180;
    const double ratio = theta / (std::numbers::pi / 2 - theta);
    const double metres = 0.0012 + 0.0019 * 0.1 * 0.1 + 0.0001 / std::sqrt(0.5) * ratio * ratio;
    EXPECT_NEAR(seen.sd, 1000 * metres, 0.015 * 1000 * metres) << degrees;
  }
}

TEST(SensorNoise, LateralWanderActsAlongTheSlope) {
  ExactView slope = wall(500.0);
  for (int v = 0; v < slope.height; ++v) {
    for (int u = 0; u < slope.width; ++u) {
      slope.depth_mm[static_cast<std::size_t>(v * slope.width + u)] =
          500.0F + 0.5F * static_cast<float>(u);
    }
  }
  NoiseSettings settings = NoiseSettings::for_law(NoiseLaw::kNone);
  settings.lateral_px = 0.6;
  const auto raw = noisy_frame(slope, settings, 4);
  double squares = 0.0;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const double error = raw[i] * 0.1 - static_cast<double>(slope.depth_mm[i]);
    squares += error * error;
  }
  const double sd = std::sqrt(squares / static_cast<double>(raw.size()));
  EXPECT_NEAR(sd, std::hypot(0.5 * 0.6, 0.1 / std::sqrt(12.0)), 0.01);
}

TEST(SensorNoise, LosesMoreTheMoreGrazing) {
  const auto lost = [](double degrees) {
    return statistics_of(noisy_frame(wall(500.0, degrees), {}, 5), 0.1).share_lost;
  };
  EXPECT_LT(lost(70.0), 0.01);
  EXPECT_NEAR(lost(77.0), 0.5, 0.02);
  const auto none_left = noisy_frame(wall(500.0, 83.0), {}, 5);
  EXPECT_EQ(std::set(none_left.begin(), none_left.end()), std::set<std::uint16_t>{0});
}

TEST(SensorNoise, PixelsFlyAtSilhouettesOnly) {
  ExactView step = wall(500.0);
  for (int v = 0; v < step.height; ++v) {
    for (int u = 0; u < step.width; ++u) {
      const auto pixel = static_cast<std::size_t>(v * step.width + u);
      if (u >= 200) step.depth_mm[pixel] = 600.0F;
      step.edge[pixel] = u == 199 || u == 200 ? 1 : 0;
    }
  }
  const auto raw = noisy_frame(step, {}, 6);
  int flying = 0;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] < 5050 || raw[i] > 5950) continue;
    ++flying;
    EXPECT_EQ(step.edge[i], 1);
  }
  EXPECT_NEAR(flying, 2 * 400 * 0.35 * 0.9, 50);
}

TEST(SensorNoise, SameSeedSameBytes) {
  const ExactView view = wall(600.0, 20.0);
  EXPECT_EQ(noisy_frame(view, {}, 11), noisy_frame(view, {}, 11));
  EXPECT_NE(noisy_frame(view, {}, 11), noisy_frame(view, {}, 12));
}

TEST(SensorNoise, DepthBeyondTheFormatIsNoData) {
  EXPECT_EQ(noisy_frame(wall(7000.0, 0, 4), NoiseSettings::for_law(NoiseLaw::kNone), 1),
            std::vector<std::uint16_t>(16, 0));
}

}  // namespace
}  // namespace instep
