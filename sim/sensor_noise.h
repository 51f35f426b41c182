#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/depth_renderer.h"

namespace instep {

/// How the depth of a pixel scatters from frame to frame, one standard deviation.
enum class NoiseLaw {
  kNone,
  /// 1.425e-6 Z^2 mm (0.36 mm at 0.5 m): the quadratic law of triangulating sensors with the
  /// coefficient of Khoshelham and Elberink.
  kTypical,
  /// 1.2 + 1.9 (z-0.4)^2 + 0.1/sqrt(z) a^2/(pi/2-a)^2 mm, z in metres, a the incidence: Nguyen,
  /// Izadi and Lovell (1.2 mm at 0.5 m).
  kPessimistic,
};

std::optional<NoiseLaw> noise_law_from_string(std::string_view name);  ///< none typical pessimistic

/// What a raw depth of 1 is worth; depths are rounded to whole ones.
inline constexpr double kSimulatedDepthUnitMm = 0.1;

struct NoiseSettings {
  NoiseLaw law = NoiseLaw::kTypical;
  /// Wander of the line of sight, in pixels, at normal incidence; it grows with the incidence a by
  /// a further 0.035 a/(pi/2-a), as in Nguyen, Izadi and Lovell.
  double lateral_px = 0.3;
  double random_dropout = 0.005;  ///< share of pixels without data, anew in each frame
  /// Data fades out between these angles of incidence.
  double fading_deg = 72.0;
  double lost_deg = 82.0;
  /// Share of edge pixels that show a depth between the two surfaces, and that show none.
  double flying = 0.35;
  double lost_at_edge = 0.25;

  /// The settings that go with a law; kNone rounds, no more.
  static NoiseSettings for_law(NoiseLaw law);
};

/// Standard deviation along the line of sight, in mm, for NoiseSettings::law.
double axial_sigma_mm(NoiseLaw law, double depth_mm, double incidence_rad);

/// Turns an exact view into the integers of one frame. The same view, settings and seed give the
/// same values; use a seed of its own for every camera and frame. Cost: about 10 ms for 640x480.
std::vector<std::uint16_t> noisy_frame(const ExactView& view, const NoiseSettings& settings,
                                       std::uint64_t seed);

}  // namespace instep
