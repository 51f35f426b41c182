#include "core/geometry/drawn_local_errors.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

namespace instep {
namespace {

constexpr std::size_t kWaves = 32;

struct Wave {
  Eigen::Vector3d number = Eigen::Vector3d::Zero();  ///< radians a millimetre
  double phase = 0.0;
};

/// By itself, not by a distribution of the library: that may draw otherwise elsewhere.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : bits_(seed) {}

  /// From (0, 1].
  double uniform() { return (static_cast<double>(bits_() >> 11U) + 1.0) * 0x1.0p-53; }

  /// By Box and Muller.
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 bits_;
};

std::array<Wave, kWaves> drawn_waves(double reach_mm, std::uint64_t draw) {
  Draws draws(draw / 2);
  const double quarter = draw % 2 == 0 ? 0.0 : 0.5 * std::numbers::pi;
  std::array<Wave, kWaves> waves;
  for (auto& wave : waves) {
    for (double& part : wave.number) part = std::numbers::sqrt2 / reach_mm * draws.normal();
    wave.phase = 2.0 * std::numbers::pi * draws.uniform() + quarter;
  }
  return waves;
}

}  // namespace

std::vector<double> drawn_local_errors(const PointCloud& cloud, std::uint64_t draw) {
  const auto& [sigma, reach] = cloud.local_errors;
  std::vector<double> errors;
  if (sigma.empty()) return errors;
  const auto waves = drawn_waves(reach, draw);
  const double height = std::sqrt(2.0 / static_cast<double>(kWaves));
  errors.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    double sum = 0.0;
    for (const auto& wave : waves)
      sum += std::cos(wave.number.dot(cloud.positions[i]) + wave.phase);
    errors.push_back(sigma[i] * height * sum);
  }
  return errors;
}

}  // namespace instep
