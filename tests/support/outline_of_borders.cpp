#include "tests/support/outline_of_borders.h"

#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep::test {

FootOutline outline_with(const Border& medial, const Border& lateral, double length_mm,
                         double noise_mm, std::uint64_t seed, std::size_t points,
                         const std::function<bool(double, bool)>& is_seen) {
  RandomNumbers random(seed);
  FootScan foot;
  constexpr double kRoundMm = 12.0;
  constexpr double kGuessedTooFarInMm = 12.0;
  for (std::size_t i = 0; i < points; ++i) {
    const double x = random.uniform(0.0, length_mm);
    const double angle = random.uniform(-0.5, 0.5) * std::numbers::pi;
    double in = kRoundMm * (1.0 - std::cos(angle)) - noise_mm * random.normal();
    const bool is_medial = random.uniform() < 0.5;
    if (is_seen) {
      const bool was_seen = is_seen(x, is_medial);
      if (!was_seen) in += kGuessedTooFarInMm;
      foot.cloud.origins.push_back(was_seen ? PointOrigin::kSeen : PointOrigin::kPlatform);
    }
    foot.cloud.positions.emplace_back(x, is_medial ? medial(x) - in : in - lateral(x),
                                      kRoundMm * (1.0 + std::sin(angle)));
  }
  foot.landmarks["pternion"].position_mm = Eigen::Vector3d::Zero();
  foot.landmarks["acropodion"].position_mm = Eigen::Vector3d(length_mm, 0.0, 10.0);
  return FootOutline(foot);
}

}  // namespace instep::test
