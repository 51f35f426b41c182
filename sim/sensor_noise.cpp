#include "sim/sensor_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/degree.h"
#include "sim/random.h"

namespace instep {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2.0;

/// Normal deviates by table: the quantiles at the middles of 4096 equal shares, so that 12 random
/// bits make one (largest 3.7, variance 0.9995).
class NormalTable {
 public:
  NormalTable() {
    for (std::size_t i = 0; i < quantiles_.size(); ++i) {
      quantiles_[i] = quantile((static_cast<double>(i) + 0.5) / 4096.0);
    }
  }
  double operator()(std::uint64_t bits) const { return quantiles_[bits & 4095U]; }

 private:
  static double quantile(double share) {
    double low = -6.0, high = 6.0;
    while (high - low > 1e-12) {
      const double middle = 0.5 * (low + high);
      (0.5 * std::erfc(-middle / std::numbers::sqrt2) < share ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  std::array<double, 4096> quantiles_;
};

/// One draw of 64 bits serves a pixel: three normal deviates and a uniform one.
struct PixelChance {
  PixelChance(std::uint64_t bits, const NormalTable& normal)
      : along(normal(bits)),
        right(normal(bits >> 12U)),
        down(normal(bits >> 24U)),
        share(static_cast<double>(bits >> 36U) * 0x1.0p-28) {}
  double along;
  double right;
  double down;
  double share;  ///< from [0, 1)
};

std::uint16_t quantised(double depth_mm) {
  if (!(depth_mm > 0.0)) return 0;
  const double units = std::round(depth_mm / kSimulatedDepthUnitMm);
  return units >= 1.0 && units <= 65535.0 ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
}

class FrameMaker {
 public:
  FrameMaker(const ExactView& view, const NoiseSettings& settings)
      : view_(view), settings_(settings) {}

  double depth_of(int u, int v, const PixelChance& chance) const {
    const std::size_t pixel = index(u, v);
    const double exact = static_cast<double>(view_.depth_mm[pixel]);
    if (exact <= 0.0) return 0.0;
    const double incidence = static_cast<double>(view_.incidence_rad[pixel]);
    double share = chance.share;
    const double lost = 1.0 - (1.0 - settings_.random_dropout) * (1.0 - faded(incidence));
    if (share < lost) return 0.0;
    share = (share - lost) / (1.0 - lost);
    double depth = 0.0;
    if (view_.edge[pixel] != 0) {
      if (share < settings_.lost_at_edge) return 0.0;
      const bool flies = share < settings_.lost_at_edge + settings_.flying;
      depth = flies ? between_surfaces(u, v, (share - settings_.lost_at_edge) / settings_.flying)
                    : exact;
    } else {
      depth = wandered(u, v, incidence, chance);
    }
    return depth + axial_sigma_mm(settings_.law, exact, incidence) * chance.along;
  }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(view_.width) +
           static_cast<std::size_t>(u);
  }

  double faded(double incidence) const {
    const double degrees = incidence / kDegree;
    return std::clamp(
        (degrees - settings_.fading_deg) / (settings_.lost_deg - settings_.fading_deg), 0.0, 1.0);
  }

  /// The depth at `share` of the way from the nearest to the furthest neighbour.
  double between_surfaces(int u, int v, double share) const {
    float nearest = std::numeric_limits<float>::infinity();
    float furthest = 0.0F;
    for (int vn = std::max(0, v - 1); vn <= std::min(view_.height - 1, v + 1); ++vn) {
      for (int un = std::max(0, u - 1); un <= std::min(view_.width - 1, u + 1); ++un) {
        const float depth = view_.depth_mm[index(un, vn)];
        if (depth <= 0.0F) continue;
        nearest = std::min(nearest, depth);
        furthest = std::max(furthest, depth);
      }
    }
    return static_cast<double>(nearest) + share * static_cast<double>(furthest - nearest);
  }

  /// The depth where a line of sight that wandered from the pixel's centre meets the same surface:
  /// along the surface's slope in the image.
  double wandered(int u, int v, double incidence, const PixelChance& chance) const {
    const double here = static_cast<double>(view_.depth_mm[index(u, v)]);
    if (settings_.lateral_px <= 0.0) return here;
    const double sd =
        settings_.lateral_px + 0.035 * incidence / std::max(0.05, kHalfPi - incidence);
    const double right = chance.right * sd;
    const double down = chance.down * sd;
    const int un = u + (right >= 0.0 ? 1 : -1);
    const int vn = v + (down >= 0.0 ? 1 : -1);
    return here + std::abs(right) * slope_to(un, v, here) + std::abs(down) * slope_to(u, vn, here);
  }

  double slope_to(int u, int v, double here) const {
    if (u < 0 || v < 0 || u >= view_.width || v >= view_.height) return 0.0;
    const double there = static_cast<double>(view_.depth_mm[index(u, v)]);
    return there > 0.0 ? there - here : 0.0;
  }

  const ExactView& view_;
  const NoiseSettings& settings_;
};

}  // namespace

std::optional<NoiseLaw> noise_law_from_string(std::string_view name) {
  if (name == "none") return NoiseLaw::kNone;
  if (name == "typical") return NoiseLaw::kTypical;
  if (name == "pessimistic") return NoiseLaw::kPessimistic;
  return std::nullopt;
}

NoiseSettings NoiseSettings::for_law(NoiseLaw law) {
  NoiseSettings settings;
  settings.law = law;
  if (law == NoiseLaw::kPessimistic) settings.lateral_px = 0.8;
  if (law == NoiseLaw::kNone) {
    settings.lateral_px = 0.0;
    settings.random_dropout = 0.0;
    settings.fading_deg = 90.0;
    settings.lost_deg = 91.0;
    settings.flying = 0.0;
    settings.lost_at_edge = 0.0;
  }
  return settings;
}

double axial_sigma_mm(NoiseLaw law, double depth_mm, double incidence_rad) {
  if (law == NoiseLaw::kNone) return 0.0;
  if (law == NoiseLaw::kTypical) return 1.425e-6 * depth_mm * depth_mm;
  const double z = depth_mm / 1000.0;
  const double grazing = incidence_rad / std::max(0.05, kHalfPi - incidence_rad);
  return 1.2 + 1.9 * (z - 0.4) * (z - 0.4) + 0.1 / std::sqrt(z) * grazing * grazing;
}

std::vector<std::uint16_t> noisy_frame(const ExactView& view, const NoiseSettings& settings,
                                       std::uint64_t seed) {
  static const NormalTable kNormal;
  const FrameMaker maker(view, settings);
  Random random(seed);
  std::vector<std::uint16_t> raw(view.depth_mm.size());
  std::size_t pixel = 0;
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u, ++pixel) {
      const PixelChance chance(random.bits(), kNormal);
      raw[pixel] = quantised(maker.depth_of(u, v, chance));
    }
  }
  return raw;
}

}  // namespace instep
