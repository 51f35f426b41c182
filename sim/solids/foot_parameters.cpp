#include "sim/solids/foot_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/random.h"

namespace instep {

FootParameters draw_foot(std::uint64_t seed, Side side) {
  Random random(seed);
  FootParameters foot;
  foot.side = side;
  foot.length_mm = random.uniform(200.0, 310.0);
  foot.ball_breadth_mm = foot.length_mm * random.uniform(0.36, 0.42);
  foot.heel_breadth_mm = foot.length_mm * random.uniform(0.23, 0.27);
  foot.instep_height_mm = foot.length_mm * random.uniform(0.23, 0.28);
  foot.arch_lift_mm = random.uniform(-6.0, 8.0);
  foot.second_toe_mm = random.uniform(-8.0, 5.0);
  foot.toe_separation = random.uniform();
  foot.hallux_angle_deg = random.uniform(0.0, 14.0);
  foot.ankle_girth_mm = foot.length_mm * random.uniform(0.80, 1.0);
  foot.lean_forward_deg = random.uniform(-4.0, 8.0);
  foot.lean_medial_deg = random.uniform(-4.0, 4.0);
  foot.leg_height_mm = random.uniform(300.0, 360.0);
  foot.rim_radius_mm = random.uniform(5.0, 8.0);
  return foot;
}

namespace {

struct Range {
  const char* name;
  double value;
  double lowest;
  double highest;
};

}  // namespace

Result<void> check_foot_parameters(const FootParameters& foot) {
  const double length = foot.length_mm;
  const Range ranges[] = {
      {"length_mm", length, 150.0, 350.0},
      {"ball_breadth_mm", foot.ball_breadth_mm, 0.32 * length, 0.46 * length},
      {"heel_breadth_mm", foot.heel_breadth_mm, 0.20 * length, 0.30 * length},
      {"instep_height_mm", foot.instep_height_mm, 0.20 * length, 0.32 * length},
      {"arch_lift_mm", foot.arch_lift_mm, -10.0, 12.0},
      {"second_toe_mm", foot.second_toe_mm, -15.0, 10.0},
      {"toe_separation", foot.toe_separation, 0.0, 1.0},
      {"hallux_angle_deg", foot.hallux_angle_deg, 0.0, 25.0},
      {"ankle_girth_mm", foot.ankle_girth_mm, 0.7 * length, 1.2 * length},
      {"lean_forward_deg", foot.lean_forward_deg, -10.0, 15.0},
      {"lean_medial_deg", foot.lean_medial_deg, -8.0, 8.0},
      {"leg_height_mm", foot.leg_height_mm, 200.0, 450.0},
      {"rim_radius_mm", foot.rim_radius_mm, 2.0, 10.0},
  };
  for (const Range& range : ranges) {
    if (!(range.value >= range.lowest && range.value <= range.highest)) {
      return fail(ErrorCode::kInvalidInput,
                  fmt::format("a foot cannot have {} = {}", range.name, range.value),
                  fmt::format("choose between {:.4g} and {:.4g}", range.lowest, range.highest));
    }
  }
  return {};
}

}  // namespace instep
