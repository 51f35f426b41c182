#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace instep {

/// Definitions of which several are in use, a foot's measures with them: makers and standards
/// differ, and the same foot differs with them by millimetres. The first of each is the default.

/// The direction that lengths are measured along and breadths square to, on the floor.
enum class AxisRule {
  kSecondToe,      ///< from the pternion to the tip of the second toe (JIS, AIST)
  kBallCentre,     ///< from the pternion to the middle between the two points of the ball (INFOOT)
  kHeelCentre,     ///< the line of the heel's middles, over its rear 0.03-0.13 of the length
  kMedialTangent,  ///< parallel to a ruler that touches heel and ball on the medial side (Brannock)
  kOutline,        ///< the longer principal axis of the outline's area
};

/// The plane of the ball girth, over metatarsale tibiale and fibulare.
enum class BallGirthRule {
  kUpright,   ///< square to the floor (JIS, AIST)
  kShortest,  ///< tilted about the two points until the tape is shortest, up to 20 degrees
};

enum class InstepGirthRule {
  kMidfoot,  ///< over the instep point, by the lateral midfoot and the medial arch
  kUpright,  ///< square to the floor and to the axis at half the length (INFOOT)
};

/// Where the heel's breadth is taken, square to the axis.
enum class HeelBreadthRule {
  kSixth,        ///< at a sixth of the length
  kFortyMm,      ///< 40 mm in front of the pternion
  kWidestFifth,  ///< where it is greatest in the rear fifth of the length
};

/// In the words of a definition: "parallel to the axis ...", "breadth ...".
const char* description(AxisRule axis);
const char* description(HeelBreadthRule place);

struct MeasuringRules {
  AxisRule axis = AxisRule::kSecondToe;
  BallGirthRule ball_girth = BallGirthRule::kUpright;
  InstepGirthRule instep_girth = InstepGirthRule::kMidfoot;
  HeelBreadthRule heel_breadth = HeelBreadthRule::kSixth;

  bool operator==(const MeasuringRules&) const = default;
};

/// All four by their names: "axis pt_toe2, ball girth upright, ...".
std::string in_words(const MeasuringRules& rules);

/// By which choice a measure was taken, where that is not the default: "shortest" of `ball_girth`,
/// "axis brannock" of `foot_length`, which all look at first. Else empty.
std::string own_choice(std::string_view measure_id, const MeasuringRules& rules);

/// The names of the choices in files and on the command line.
template <typename Rule, std::size_t Count>
using RuleNames = std::array<std::pair<std::string_view, Rule>, Count>;

inline constexpr RuleNames<AxisRule, 5> kAxisRules{{{"pt_toe2", AxisRule::kSecondToe},
                                                    {"pt_cp", AxisRule::kBallCentre},
                                                    {"heel_centre", AxisRule::kHeelCentre},
                                                    {"brannock", AxisRule::kMedialTangent},
                                                    {"pca", AxisRule::kOutline}}};
inline constexpr RuleNames<BallGirthRule, 2> kBallGirthRules{
    {{"upright", BallGirthRule::kUpright}, {"shortest", BallGirthRule::kShortest}}};
inline constexpr RuleNames<InstepGirthRule, 2> kInstepGirthRules{
    {{"midfoot", InstepGirthRule::kMidfoot}, {"upright", InstepGirthRule::kUpright}}};
inline constexpr RuleNames<HeelBreadthRule, 3> kHeelBreadthRules{
    {{"sixth", HeelBreadthRule::kSixth},
     {"40mm", HeelBreadthRule::kFortyMm},
     {"widest", HeelBreadthRule::kWidestFifth}}};

template <typename Rule, std::size_t Count>
constexpr std::string_view name_of(Rule rule, const RuleNames<Rule, Count>& names) {
  for (const auto& [name, one] : names) {
    if (one == rule) return name;
  }
  return "";
}

}  // namespace instep
