#include "core/foot/measures.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/foot/foot_lengths.h"
#include "core/foot/foot_tapes.h"
#include "core/foot/redrawn_landmarks.h"
#include "core/foot/rough_tape.h"
#include "core/foot/shoe_last.h"
#include "core/foot/standing_girth.h"
#include "core/fusion/close_sole.h"

namespace instep {
namespace {

// Girths of feet are 0.85 to 1.2 of their length; far beyond that the surface went astray.
constexpr double kLeastGirthShare = 0.65;
constexpr double kMostGirthShare = 1.65;

// Heels are about a quarter of the foot's length; where one side was not seen, a sliver is left.
constexpr double kLeastHeelShare = 0.125;

// Over drawn feet (tests/bench/feet) heights are out by half a millimetre with the floor that they
// are counted from, which the scatter of the redraws does not show; at the toes by more, since a
// floor that leans by a third of a degree has no contact there to tell it.
constexpr double kFloorDoubtMm = 0.5;
constexpr double kFloorDoubtAtToesMm = 0.9;

// Feet of one length differ in breadths and girths by an eighth to either side at the most: a wider
// interval says less than that length. Of an arch or a toe an eighth is hardly more than the doubt
// of a floor, and toes point within twenty degrees.
constexpr double kUselessShare = 0.125;
constexpr double kUselessMm = 5.0;
constexpr double kUselessDegrees = 10.0;

struct LengthRule {
  const char* id;
  Result<double> (*length)(const Landmarks&);
  std::vector<const char*> landmarks;
  const char* definition;
  enum class Kind { kLength, kAngle } kind = Kind::kLength;
  double floor_doubt_mm = 0.0;  ///< of a height, where the floor is told by the sole alone
  /// What the patch that tells a landmark pulls it aside by: over drawn feet, as below.
  double own_doubt_mm = 0.0;
};

struct GirthRule {
  const char* id;
  std::function<Result<TapePlane>(const Landmarks&)> tape;
  std::vector<const char*> landmarks;
  const char* definition;
  /// What the rule's own terms leave open where a landmark is told by a bend hardly seen, or by a
  /// patch so wide that it pulls the landmark aside: over drawn feet (tests/bench/feet), and not to
  /// be seen in the scatter of redraws.
  double own_doubt_mm = 0.0;
};

const std::vector<LengthRule>& length_rules() {
  static const std::vector<LengthRule> rules{
      {"foot_length",
       foot_length,
       {},
       "from the pternion to the foremost toe, parallel to the axis "},
      {"foot_breadth",
       foot_breadth,
       {"metatarsale_tibiale", "metatarsale_fibulare"},
       "from metatarsale tibiale to metatarsale fibulare, in floor projection"},
      {"foot_breadth_horizontal",
       foot_breadth_horizontal,
       {},
       "extent of the outline up to 25 mm over the floor, at right angles to the axis, in "
       "0.50-0.85 "
       "of the foot's length"},
      {"heel_breadth",
       heel_breadth,
       {},
       "extent of the outline up to 25 mm over the floor, at right angles to the axis, "},
      {"ball_length",
       ball_length,
       {"metatarsale_tibiale"},
       "from the pternion to metatarsale tibiale, parallel to the axis",
       LengthRule::Kind::kLength,
       0.0,
       0.6},
      {"outside_ball_length",
       outside_ball_length,
       {"metatarsale_fibulare"},
       "from the pternion to metatarsale fibulare, parallel to the axis",
       LengthRule::Kind::kLength,
       0.0,
       0.4},
      {"instep_height",
       instep_height,
       {},
       "height over the floor of the foot's back at 0.50 of its length",
       LengthRule::Kind::kLength,
       kFloorDoubtMm},
      {"ball_height",
       ball_height,
       {"metatarsale_tibiale", "metatarsale_fibulare"},
       "greatest height over the floor of the upright section over metatarsale tibiale and "
       "fibulare",
       LengthRule::Kind::kLength,
       kFloorDoubtMm},
      {"arch_height",
       arch_height,
       {},
       "greatest height over the floor of the underside a quarter of the breadth from the medial "
       "border, in 0.35-0.60 of the foot's length",
       LengthRule::Kind::kLength,
       kFloorDoubtMm},
      {"toe1_height",
       toe1_height,
       {},
       "height over the floor of the first toe 15 mm behind its tip",
       LengthRule::Kind::kLength,
       kFloorDoubtAtToesMm},
      {"toe1_angle",
       toe1_angle,
       {"metatarsale_tibiale"},
       "between the line from the heel's medial point to metatarsale tibiale and the line from "
       "there to where a ruler touches the first toe; positive towards the other toes",
       LengthRule::Kind::kAngle},
      {"toe5_angle",
       toe5_angle,
       {"metatarsale_fibulare"},
       "between the line from the heel's lateral point to metatarsale fibulare and the line from "
       "there to where a ruler touches the little toe; positive towards the other toes",
       LengthRule::Kind::kAngle},
  };
  return rules;
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
    const auto length = tape ? rough_tape(foot.cloud.positions, *tape) : std::nullopt;
    if (!length || *length >= least) continue;
    least = *length;
    best = lean;
  }
  return best;
}

GirthRule ball_rule(const FootScan& foot) {
  GirthRule rule{"ball_girth",
                 ball_tape,
                 {"metatarsale_tibiale", "metatarsale_fibulare"},
                 "stretched tape in the upright plane over metatarsale tibiale and fibulare",
                 0.4};
  if (foot.rules.ball_girth == BallGirthRule::kShortest) {
    rule.tape = [lean = shortest_lean_deg(foot)](const Landmarks& landmarks) {
      return leaning_ball_tape(landmarks, lean);
    };
    rule.definition =
        "stretched tape over metatarsale tibiale and fibulare, leaning by as much, up to 20 "
        "degrees, as makes it shortest";
  }
  return rule;
}

GirthRule instep_rule(const FootScan& foot) {
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

std::vector<GirthRule> girth_rules(const FootScan& foot) {
  return {
      ball_rule(foot),
      {"waist_girth",
       waist_tape,
       {"metatarsale_tibiale", "metatarsale_fibulare", "instep_point", "lateral_midfoot",
        "medial_arch"},
       "stretched tape in the plane midway between the upright one over metatarsale tibiale and "
       "fibulare and the one over instep point, lateral midfoot and medial arch"},
      instep_rule(foot),
      {"short_heel_girth",
       short_heel_tape,
       {"heel_point", "junction"},
       "stretched tape round the heel point and over the junction of foot and leg, square to the "
       "side view",
       0.4},
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

/// What each redraw of the landmarks gives; nothing where it gives nothing.
template <typename Taker>
std::optional<double> spread_over_redraws(const FootScan& foot, const Taker& taken) {
  std::vector<std::optional<double>> values;
  for (const auto& redrawn : foot.redraws.landmarks) values.push_back(taken(redrawn));
  const auto u95 = u95_of_redraws(values, foot.redraws.parting);
  return u95 ? std::optional(kSharedDoubt * *u95) : std::nullopt;
}

std::optional<double> u95_of(const LengthRule& rule, const FootScan& foot) {
  return spread_over_redraws(foot, [&](const RedrawnLandmarks& redrawn) -> std::optional<double> {
    const auto length = rule.length(redrawn.landmarks);
    return length ? std::optional(*length) : std::nullopt;
  });
}

/// How far a girth moves with its landmarks: the tape of each redraw laid round the same points.
std::optional<double> u95_of(const GirthRule& rule, const FootScan& foot) {
  return spread_over_redraws(foot, [&](const RedrawnLandmarks& redrawn) -> std::optional<double> {
    const auto tape = rule.tape(redrawn.landmarks);
    if (!tape) return std::nullopt;
    return rough_tape(foot.cloud.positions, tape->transformed(redrawn.foot_from_redrawn));
  });
}

std::vector<std::string> doubts(const FootScan& foot, const std::vector<const char*>& landmarks) {
  std::vector<std::string> warnings;
  for (const char* name : landmarks) {
    const auto found = foot.landmarks.find(name);
    if (found != foot.landmarks.end() && found->second.is_placed_by_proportion()) {
      warnings.push_back(std::string(name) + " is placed by proportion");
    }
  }
  return warnings;
}

/// What a definition says that depends on the rules.
std::string addition_of(const std::string& id, const MeasuringRules& rules) {
  if (id == "foot_length") {
    return std::string(description(rules.axis)) + " (" +
           std::string(name_of(rules.axis, kAxisRules)) + ")";
  }
  return id == "heel_breadth" ? description(rules.heel_breadth) : "";
}

/// Of the foot itself only: redraws that fell out would hide how uncertain a breadth is.
Result<void> check_heel(double breadth_mm, const FootScan& foot) {
  const auto length = foot_length(foot.landmarks);
  if (!length || breadth_mm >= kLeastHeelShare * *length) return {};
  return fail(ErrorCode::kInsufficientData, "the heel is too narrow for a whole one",
              "scan the foot again, from all sides");
}

Result<Measure> take(const LengthRule& rule, const FootScan& foot) {
  const auto length = rule.length(foot.landmarks);
  if (!length) return tl::unexpected(length.error());
  if (rule.length == heel_breadth) {
    if (auto whole = check_heel(*length, foot); !whole) return tl::unexpected(whole.error());
  }
  Measure measure;
  measure.id = rule.id;
  auto u95 = u95_of(rule, foot);
  if (u95) u95 = std::hypot(*u95, rule.own_doubt_mm);
  if (u95 && !foot.is_floor_known) u95 = std::hypot(*u95, rule.floor_doubt_mm);
  if (rule.kind == LengthRule::Kind::kAngle) {
    measure.value_mm = std::numeric_limits<double>::quiet_NaN();
    measure.value_deg = *length;
    measure.u95_deg = u95;
  } else {
    measure.value_mm = *length;
    measure.u95_mm = u95;
  }
  if (u95) measure.parts = DoubtParts{0.0, *u95};
  measure.definition = rule.definition + addition_of(rule.id, foot.rules);
  measure.warnings = doubts(foot, rule.landmarks);
  return measure;
}

/// What a tape may be wrong by for running over skin that was not seen and is taken to go on from
/// the wall above it (close_sole()): a share of its length there, as drawn feet without soles have
/// it (tests/bench/feet).
double doubt_of_guessed_skin(const PointCloud& cloud, const TapePlane& plane) {
  constexpr double kDoubtShare = 0.035;
  constexpr double kBandMm = 2.0;
  constexpr double kOverFloorMm = 0.3;
  const double spacing = SoleSettings{}.spacing_mm;
  double points = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool is_guessed = !cloud.was_seen(i) && cloud.positions[i].z() > kOverFloorMm &&
                            std::abs(plane.distance(cloud.positions[i])) < kBandMm;
    if (is_guessed) points += 1.0;
  }
  return kDoubtShare * points * spacing * spacing / (2.0 * kBandMm);
}

Result<void> check_share(double girth_mm, const FootScan& foot) {
  const auto length = foot_length(foot.landmarks);
  if (!length) return tl::unexpected(length.error());
  const double share = girth_mm / *length;
  if (share >= kLeastGirthShare && share <= kMostGirthShare) return {};
  return fail(ErrorCode::kInsufficientData, "the surface there is no foot's",
              "scan again, with the foot in full view of all cameras");
}

Result<Measure> take(const GirthRule& rule, const FootScan& foot, const MeasureOptions& options) {
  const auto plane = rule.tape(foot.landmarks);
  if (!plane) return tl::unexpected(plane.error());
  auto girth = options.girth(foot.cloud, *plane, options.girth_options);
  if (!girth) return tl::unexpected(girth.error());
  if (foot.cloud.stands_on_platform()) girth = standing_girth(*std::move(girth), *plane);
  if (auto sane = check_share(girth->stretched_mm, foot); !sane) {
    return tl::unexpected(sane.error());
  }
  Measure measure;
  measure.id = rule.id;
  measure.value_mm = girth->stretched_mm;
  // The tape's own interval alone, without that of the landmarks that place the tape, would promise
  // too much.
  const auto by_landmarks = u95_of(rule, foot);
  if (by_landmarks && girth->stretched_u95_mm) {
    const double surface =
        std::hypot(*girth->stretched_u95_mm, doubt_of_guessed_skin(foot.cloud, *plane));
    measure.parts = DoubtParts{surface, std::hypot(*by_landmarks, rule.own_doubt_mm)};
    measure.u95_mm = std::hypot(measure.parts->surface, measure.parts->landmarks);
  }
  measure.plane = *plane;
  measure.definition = rule.definition;
  measure.warnings = doubts(foot, rule.landmarks);
  measure.warnings.insert(measure.warnings.end(), girth->warnings.begin(), girth->warnings.end());
  measure.girth = *std::move(girth);
  return measure;
}

/// Whether the interval holds so much that a foot which was not measured could be told as well.
bool is_useless(const Measure& measure) {
  if (!measure.u95()) return false;
  const double limit = measure.value_deg
                           ? kUselessDegrees
                           : std::max(kUselessMm, kUselessShare * std::abs(measure.value_mm));
  return *measure.u95() > limit;
}

std::string why_useless(const Measure& measure) {
  return "it is told to no better than +-" + std::to_string(std::lround(*measure.u95())) +
         (measure.value_deg ? " degrees" : " mm") +
         ": scan again with more frames, and one foot alone in full view of all cameras";
}

/// What a shoe last has nothing of: no scan brings it.
bool is_of_feet_only(const std::string& id) {
  for (const char* one : {"heel_breadth", "arch_height", "toe1_height", "toe1_angle", "toe5_angle",
                          "short_heel_girth", "ankle_girth"}) {
    if (id == one) return true;
  }
  return false;
}

void keep(MeasureSet& set, const char* id, bool is_last, Result<Measure> measure) {
  if (measure && is_useless(*measure)) {
    set.withheld.push_back({id, why_useless(*measure)});
  } else if (measure) {
    set.measures.push_back(*std::move(measure));
  } else if (is_last && is_of_feet_only(id)) {
    set.withheld.push_back({id, "a shoe last has none"});
  } else {
    set.withheld.push_back({id, measure.error().line()});
  }
}

}  // namespace

Result<MeasureSet> measure_foot(const FootScan& foot, const MeasureOptions& options,
                                const GoOn& go_on) {
  for (const char* name : {"pternion", "acropodion", "instep_point"}) {
    if (!foot.landmarks.contains(name)) {
      return fail(ErrorCode::kInvalidInput, std::string("the foot has no landmark ") + name,
                  "align it and find its landmarks first, and scan again if one is missing");
    }
  }
  MeasureSet set;
  const bool is_last = is_shoe_last(foot);
  for (const auto& rule : length_rules()) {
    keep(set, rule.id, is_last, take(rule, foot));
    if (!go_on()) return cancelled();
  }
  const auto rules = girth_rules(foot);
  std::vector<std::optional<Result<Measure>>> girths(rules.size());
  std::atomic<bool> wanted = true;
  options.workers(rules.size(), [&](std::size_t i) {
    if (!wanted) return;
    girths[i] = take(rules[i], foot, options);
    if (!go_on()) wanted = false;
  });
  if (!wanted) return cancelled();
  for (std::size_t i = 0; i < rules.size(); ++i) {
    keep(set, rules[i].id, is_last, *std::move(girths[i]));
  }
  return set;
}

}  // namespace instep
