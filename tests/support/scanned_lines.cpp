#include "tests/support/scanned_lines.h"

#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep::test {

std::vector<Eigen::Vector3d> ScannedLines::positions(std::uint64_t seed) const {
  constexpr double kHigh = 100.0;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  RandomNumbers random(seed);
  std::vector<Eigen::Vector3d> positions;
  const auto height = [&] {
    if (strays > 0.0 && random.uniform() < strays) {
      return (random.uniform() < 0.5 ? -1.0 : 1.0) * (1.0 + 2.0 * random.uniform());
    }
    return sigma * random.normal();
  };
  const auto put = [&](double angle, double z) {
    const Eigen::Vector3d outward =
        Eigen::Vector3d(std::cos(angle) / half_width, std::sin(angle) / half_depth, 0.0)
            .normalized();
    positions.push_back(
        Eigen::Vector3d(half_width * std::cos(angle), half_depth * std::sin(angle), z) +
        height() * outward);
  };
  const double way_round =
      kTurn * std::sqrt(0.5 * (half_width * half_width + half_depth * half_depth));
  const double turn = kTurn / std::round(way_round / (round ? step : apart));
  if (round) {
    for (double z = -kHigh + apart * random.uniform(); z < kHigh; z += apart) {
      const double first = random.uniform();
      for (double angle = turn * first; angle < kTurn; angle += turn) put(angle, z);
    }
  } else {
    for (double angle = 0.0; angle < kTurn - 0.5 * turn; angle += turn) {
      const double first = random.uniform();
      for (double z = -kHigh + step * first; z < kHigh; z += step) put(angle, z);
    }
  }
  return positions;
}

}  // namespace instep::test
