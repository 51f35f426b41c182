#include "core/foot/measuring_rules.h"

namespace instep {

const char* description(AxisRule axis) {
  switch (axis) {
    case AxisRule::kSecondToe:
      return "from the pternion to the tip of the second toe";
    case AxisRule::kBallCentre:
      return "from the pternion to the middle between metatarsale tibiale and fibulare";
    case AxisRule::kHeelCentre:
      return "of the middles of the heel's breadths";
    case AxisRule::kMedialTangent:
      return "of a ruler that touches heel and ball on the medial side";
    case AxisRule::kOutline:
      return "along which the outline's area is spread most";
  }
  return "";
}

const char* description(HeelBreadthRule place) {
  switch (place) {
    case HeelBreadthRule::kSixth:
      return "at a sixth of the foot's length";
    case HeelBreadthRule::kFortyMm:
      return "40 mm in front of the pternion";
    case HeelBreadthRule::kWidestFifth:
      return "where it is greatest in the rear fifth of the foot's length";
  }
  return "";
}

std::string in_words(const MeasuringRules& rules) {
  std::string words = "axis ";
  words += name_of(rules.axis, kAxisRules);
  words += ", ball girth ";
  words += name_of(rules.ball_girth, kBallGirthRules);
  words += ", instep girth ";
  words += name_of(rules.instep_girth, kInstepGirthRules);
  words += ", heel breadth ";
  words += name_of(rules.heel_breadth, kHeelBreadthRules);
  return words;
}

std::string own_choice(std::string_view measure_id, const MeasuringRules& rules) {
  const MeasuringRules usual;
  if (measure_id == "foot_length" && rules.axis != usual.axis) {
    return "axis " + std::string(name_of(rules.axis, kAxisRules));
  }
  if (measure_id == "ball_girth" && rules.ball_girth != usual.ball_girth) {
    return std::string(name_of(rules.ball_girth, kBallGirthRules));
  }
  if (measure_id == "instep_girth" && rules.instep_girth != usual.instep_girth) {
    return std::string(name_of(rules.instep_girth, kInstepGirthRules));
  }
  if (measure_id == "heel_breadth" && rules.heel_breadth != usual.heel_breadth) {
    return std::string(name_of(rules.heel_breadth, kHeelBreadthRules));
  }
  return {};
}

}  // namespace instep
