#include "core/foot/measures/measure_definitions.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/foot/measures/foot_lengths.h"
#include "core/foot/measures/foot_tapes.h"
#include "core/foot/sole/sunk_floor.h"
#include "core/girth/rough_tape.h"

namespace instep {
namespace {

// Over drawn feet (tests/bench/feet) heights are out by half a millimetre with the floor that they
// are counted from, which the scatter of the redraws does not show; at the toes by more, since a
// floor that leans by a third of a degree has no contact there to tell it.
constexpr double kFloorDoubtMm = 0.5;
constexpr double kFloorDoubtAtToesMm = 0.9;

// Where lines of sight wander from frame to frame, as those of real cameras do, their means lie
// inside skin that is bent tightly: toes of simulated stations by a tenth of a millimetre, and
// lengths are up to a half too short, whatever scatter is left.
constexpr double kWanderingSightMm = 0.3;

constexpr const char* kExtentSquareToAxis =
    "extent of the outline up to 25/260 of the foot's length over the floor, at right angles to "
    "the axis, ";

std::string words_of(AxisRule axis) {
  return std::string(description(axis)) + " (" + std::string(name_of(axis, kAxisRules)) + ")";
}

/// By how much the ball's tape leans where it is shortest. The length is stationary there, so that
/// the tapes of redraws may lean alike.
double shortest_lean_deg(const FootScan& foot) {
  constexpr double kMostDeg = 20.0;
  constexpr double kStepDeg = 1.0;
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (double lean = -kMostDeg; lean <= kMostDeg; lean += kStepDeg) {
    const auto tape = leaning_ball_tape(foot.landmarks, lean);
    const auto length = tape ? rough_tape(foot.shape().positions, *tape) : std::nullopt;
    if (!length || *length >= least) continue;
    least = *length;
    best = lean;
  }
  return best;
}

GirthDefinition ball_definition(const FootScan& foot) {
  GirthDefinition definition{
      "ball_girth",
      ball_tape,
      {"metatarsale_tibiale", "metatarsale_fibulare"},
      "stretched tape in the upright plane over metatarsale tibiale and fibulare",
      0.2};
  if (foot.rules.ball_girth == BallGirthRule::kShortest) {
    definition.tape = [lean = shortest_lean_deg(foot)](const Landmarks& landmarks) {
      return leaning_ball_tape(landmarks, lean);
    };
    definition.words =
        "stretched tape over metatarsale tibiale and fibulare, leaning by as much, up to 20 "
        "degrees, as makes it shortest";
  }
  return definition;
}

GirthDefinition instep_definition(const FootScan& foot) {
  if (foot.rules.instep_girth == InstepGirthRule::kUpright) {
    return {"instep_girth",
            upright_instep_tape,
            {"instep_point"},
            "stretched tape in the upright plane square to the axis at 0.50 of the foot's length"};
  }
  return {"instep_girth",
          instep_tape,
          {"instep_point", "lateral_midfoot", "medial_arch"},
          "stretched tape over the instep point at 0.50 of the foot's length, by the lateral "
          "midfoot and the point of the medial arch that makes it shortest"};
}

/// Lengths and breadths, as seen from above.
std::vector<LengthDefinition> outline_definitions(const MeasuringRules& rules) {
  return {
      {"foot_length",
       foot_length,
       {},
       "from the pternion to the foremost toe, parallel to the axis " + words_of(rules.axis),
       LengthDefinition::Kind::kLength,
       0.0,
       kWanderingSightMm},
      {"foot_breadth",
       foot_breadth,
       {"metatarsale_tibiale", "metatarsale_fibulare"},
       "from metatarsale tibiale to metatarsale fibulare, in floor projection"},
      {"foot_breadth_horizontal",
       foot_breadth_horizontal,
       {"ball_medial", "ball_lateral"},
       std::string(kExtentSquareToAxis) + "in 0.50-0.85 of that length"},
      {"heel_breadth",
       heel_breadth,
       {"heel_breadth_medial", "heel_breadth_lateral"},
       std::string(kExtentSquareToAxis) + description(rules.heel_breadth)},
      {"ball_length",
       ball_length,
       {"metatarsale_tibiale"},
       "from the pternion to metatarsale tibiale, parallel to the axis",
       LengthDefinition::Kind::kLength,
       0.0,
       0.4},
      {"outside_ball_length",
       outside_ball_length,
       {"metatarsale_fibulare"},
       "from the pternion to metatarsale fibulare, parallel to the axis",
       LengthDefinition::Kind::kLength,
       0.0,
       0.3},
  };
}

std::vector<LengthDefinition> height_definitions(const FootScan& foot) {
  const double sunk_mm = sunk_floor_mm(foot);
  const double floor_mm = std::hypot(kFloorDoubtMm, sunk_mm);
  return {
      {"instep_height",
       instep_height,
       {},
       "height over the floor of the foot's back at 0.50 of its length",
       LengthDefinition::Kind::kLength,
       floor_mm},
      {"ball_height",
       ball_height,
       {"metatarsale_tibiale", "metatarsale_fibulare", "ball_top"},
       "greatest height over the floor of the upright section over metatarsale tibiale and "
       "fibulare",
       LengthDefinition::Kind::kLength,
       floor_mm},
      {"arch_height",
       arch_height,
       {},
       "greatest height over the floor of the underside a quarter of the breadth from the medial "
       "border, in 0.35-0.60 of the foot's length",
       LengthDefinition::Kind::kLength,
       floor_mm},
      {"toe1_height",
       toe1_height,
       {},
       "height over the floor of the first toe 15/260 of the foot's length behind its tip",
       LengthDefinition::Kind::kLength,
       std::hypot(kFloorDoubtAtToesMm, sunk_mm)},
  };
}

std::vector<LengthDefinition> angle_definitions() {
  return {
      {"toe1_angle",
       toe1_angle,
       {"heel_medial", "metatarsale_tibiale"},
       "between the line from the heel's medial point to metatarsale tibiale and the line from "
       "there to where a ruler touches the first toe; positive towards the other toes",
       LengthDefinition::Kind::kAngle},
      {"toe5_angle",
       toe5_angle,
       {"heel_lateral", "metatarsale_fibulare"},
       "between the line from the heel's lateral point to metatarsale fibulare and the line from "
       "there to where a ruler touches the little toe; positive towards the other toes",
       LengthDefinition::Kind::kAngle},
  };
}

}  // namespace

std::vector<LengthDefinition> length_definitions(const FootScan& foot) {
  auto definitions = outline_definitions(foot.rules);
  for (auto& definition : height_definitions(foot)) definitions.push_back(std::move(definition));
  for (auto& definition : angle_definitions()) definitions.push_back(std::move(definition));
  return definitions;
}

std::vector<GirthDefinition> girth_definitions(const FootScan& foot) {
  return {
      ball_definition(foot),
      {"waist_girth",
       waist_tape,
       {"metatarsale_tibiale", "metatarsale_fibulare", "instep_point", "lateral_midfoot",
        "medial_arch"},
       "stretched tape in the plane midway between the upright one over metatarsale tibiale and "
       "fibulare and the one over instep point, lateral midfoot and medial arch"},
      instep_definition(foot),
      {"short_heel_girth",
       short_heel_tape,
       {"heel_point", "junction"},
       "stretched tape round the heel point and over the junction of foot and leg, square to the "
       "side view"},
      {"long_heel_girth",
       long_heel_tape,
       {"heel_point", "instep_point"},
       "stretched tape round the heel point and over the instep point, square to the side view"},
      {"ankle_girth",
       ankle_tape,
       {"medial_malleolus"},
       "stretched tape in the level plane over the medial malleolus",
       0.5},
  };
}

bool is_of_feet_only(const std::string& id) {
  for (const char* one : {"heel_breadth", "arch_height", "toe1_height", "toe1_angle", "toe5_angle",
                          "short_heel_girth", "ankle_girth"}) {
    if (id == one) return true;
  }
  return false;
}

}  // namespace instep
