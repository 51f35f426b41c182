#include "core/foot/measures.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/foot/landmarks/redrawn_landmarks.h"
#include "core/foot/measures/foot_lengths.h"
#include "core/foot/measures/hidden_skin.h"
#include "core/foot/measures/measure_definitions.h"
#include "core/foot/measures/shared_doubt.h"
#include "core/foot/measures/standing_girth.h"
#include "core/foot/measures/unseen_ends.h"
#include "core/foot/measures/useless_measure.h"
#include "core/foot/sole/floor_below.h"
#include "core/foot/standing/shoe_last.h"
#include "core/geometry/seen_skin.h"
#include "core/girth/rough_tape.h"
#include "core/in_millimetres.h"
#include "core/normal_spread.h"
#include "core/while_wanted.h"

namespace instep {
namespace {

// Girths of feet are 0.85 to 1.2 of their length; far beyond that the surface went astray.
constexpr double kLeastGirthShare = 0.65;
constexpr double kMostGirthShare = 1.65;

// Heels are about a quarter of the foot's length; where one side was not seen, a sliver is left.
constexpr double kLeastHeelShare = 0.125;

// A lower arch is not told from a sole closed by the scanner.
constexpr double kLeastArchMm = 3.0;

/// Of what a wall that was not seen leaves open of a girth.
constexpr double kWorthSayingMm = 1.0;
// Of the section's height: of a wall that was lost higher, most of the tape's way is a guess. Of 24
// pairs of simulated feet the instep's girths were up to 14 mm too long there.
constexpr double kMostHiddenShare = 0.6;

/// What is asked of a foot for each of its measures.
struct FootDoubts {
  explicit FootDoubts(const FootScan& foot)
      : seen(foot.cloud), shared(foot, seen), ends(unseen_ends(foot)), deeper(if_deeper(foot)) {}

  SeenSkin seen;
  SharedDoubt shared;
  std::optional<UnseenEnds> ends;
  std::vector<RedrawnLandmarks> deeper;  ///< if_deeper()
};

/// `redrawn`: landmarks as they may lie; a tape of them is laid round the foot's own points.
std::optional<double> taken_by(const LengthDefinition& definition, const FootScan&,
                               const RedrawnLandmarks& redrawn) {
  const auto length = definition.length(redrawn.landmarks);
  return length ? std::optional(*length) : std::nullopt;
}

std::optional<double> taken_by(const GirthDefinition& definition, const FootScan& foot,
                               const RedrawnLandmarks& redrawn) {
  const auto tape = definition.tape(redrawn.landmarks);
  if (!tape) return std::nullopt;
  return rough_tape(foot.shape().positions, tape->transformed(redrawn.foot_from_redrawn));
}

/// By the landmarks as found.
template <typename Definition>
std::optional<double> taken_here(const Definition& definition, const FootScan& foot) {
  return taken_by(definition, foot, {foot.landmarks, RigidTransform::Identity()});
}

template <typename Definition>
std::vector<std::optional<double>> taken_by_each(const Definition& definition, const FootScan& foot,
                                                 const std::vector<RedrawnLandmarks>& redraws) {
  std::vector<std::optional<double>> values;
  for (const auto& redrawn : redraws) values.push_back(taken_by(definition, foot, redrawn));
  return values;
}

/// From what the landmarks as found and each redraw of them give (`redrawn`), those left out that
/// give nothing; nothing where the landmarks as found do, or too few redraws are left.
template <typename Definition>
std::optional<double> u95_of(const Definition& definition, const FootScan& foot,
                             const std::vector<std::optional<double>>& redrawn) {
  const auto told = taken_here(definition, foot);
  return told ? u95_by_redraws(*told, redrawn, foot.redraws.parting) : std::nullopt;
}

/// How far a measure moves from the landmarks as found to others, each for itself; nothing where
/// either do not give it.
template <typename Definition>
std::optional<double> moved_by(const std::vector<RedrawnLandmarks>& others,
                               const Definition& definition, const FootScan& foot) {
  if (others.empty()) return 0.0;
  const auto here = taken_here(definition, foot);
  double squares = 0.0;
  for (const auto& other : others) {
    const auto there = taken_by(definition, foot, other);
    if (!here || !there) return std::nullopt;
    squares += std::pow(*there - *here, 2);
  }
  return std::sqrt(squares);
}

/// By where its landmarks lie instead if what redraws share is off.
template <typename Definition>
std::optional<double> u95_of_shared(const Definition& definition, const FootScan& foot) {
  std::vector<RedrawnLandmarks> others;
  for (const char* name : definition.landmarks) {
    const auto found = foot.landmarks.find(name);
    if (found == foot.landmarks.end()) continue;
    for (const auto& off : found->second.deviations_off_mm) {
      others.push_back({foot.landmarks, RigidTransform::Identity()});
      others.back().landmarks[name].position_mm += off;
    }
  }
  const auto moved = moved_by(others, definition, foot);
  return moved ? std::optional(kDeviations * *moved) : std::nullopt;
}

/// By where they lie if the foot goes on beyond ends that were not seen.
template <typename Definition>
std::optional<double> u95_of_ends(const Definition& definition, const FootScan& foot,
                                  const FootDoubts& about) {
  return about.ends ? moved_by(about.ends->if_longer, definition, foot) : 0.0;
}

/// Of all parts of a doubt; nothing if one of them is not known.
std::optional<double> root_of_squares(const std::vector<std::optional<double>>& parts) {
  double squares = 0.0;
  for (const auto& part : parts) {
    if (!part) return std::nullopt;
    squares += *part * *part;
  }
  return std::sqrt(squares);
}

/// By all that its landmarks leave open; nothing where nobody asked. Where the points were asked
/// and could not say, it hangs on a few of them, as at the border of a hole.
template <typename Definition>
Result<std::optional<double>> u95_by_landmarks(const Definition& definition, const FootScan& foot,
                                               const FootDoubts& about) {
  const auto of_ends = u95_of_ends(definition, foot, about);
  if (!of_ends) {
    return fail(ErrorCode::kInsufficientData,
                "an end of the foot was not seen, and of a longer foot it could not be taken here",
                "scan again, with all of the foot in view");
  }
  const auto redrawn = taken_by_each(definition, foot, foot.redraws.landmarks);
  const auto own = u95_of(definition, foot, redrawn);
  const auto of_local =
      u95_of_erring(redrawn, taken_by_each(definition, foot, foot.redraws.erring));
  if (own && !of_local) {
    return fail(
        ErrorCode::kInsufficientData,
        "the errors that neighbouring points share, as of a camera whose depths are bent, "
        "leave its landmarks open",
        "calibrate the depths of the cameras with their maker's tool, or let more cameras see "
        "the foot");
  }
  const auto u95 =
      root_of_squares({own, of_local, u95_of_shared(definition, foot), of_ends,
                       moved_by(about.deeper, definition, foot), definition.own_doubt_mm});
  if (u95 || foot.redraws.landmarks.empty()) return u95;
  return fail(ErrorCode::kInsufficientData, "the points do not tell how sure its landmarks are",
              "scan again, with the foot in full view of all cameras");
}

Result<Girth> girth_in(const TapePlane& plane, const FootScan& foot,
                       const MeasureOptions& options) {
  auto girth = options.girth(foot.cloud, plane, {});
  if (!girth || !foot.cloud.stands_on_platform()) return girth;
  return standing_girth(*std::move(girth), plane);
}

tl::unexpected<Error> not_of_other_foot() {
  return fail(ErrorCode::kInsufficientData,
              "the shape hardly tells left from right, and of the other foot it could not be taken "
              "here",
              std::string(kSayWhichFoot) + ", or scan again, with both its sides in view");
}

/// How far a measure is from that of the other foot, the interval of which has to be in its own; 0
/// where the side is sure.
Result<double> distance_to_other_foot(const LengthDefinition& definition, double length,
                                      const FootScan& foot) {
  const auto& other = foot.redraws.of_other_side;
  if (!other) return 0.0;
  const auto of_other = definition.length(other->landmarks);
  if (!of_other) return not_of_other_foot();
  return std::abs(*of_other - length);
}

/// By a tape of its own: rough ones are alike for planes near each other only.
Result<double> distance_to_other_foot(const GirthDefinition& definition, double girth_mm,
                                      const FootScan& foot, const MeasureOptions& options) {
  const auto& other = foot.redraws.of_other_side;
  if (!other) return 0.0;
  const auto tape = definition.tape(other->landmarks);
  if (!tape) return not_of_other_foot();
  const auto girth = girth_in(tape->transformed(other->foot_from_redrawn), foot, options);
  if (!girth) return not_of_other_foot();
  return std::abs(girth->stretched_mm - girth_mm);
}

/// An interval that reaches so much further, by its landmarks.
DoubtParts widened(const DoubtParts& parts, double further) {
  if (further == 0.0) return parts;
  const double whole = std::hypot(parts.surface, parts.landmarks) + further;
  return {parts.surface, std::sqrt(whole * whole - parts.surface * parts.surface)};
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

Result<void> check_heel(double breadth_mm, const FootScan& foot) {
  const auto length = foot_length(foot.landmarks);
  if (!length || breadth_mm >= kLeastHeelShare * *length) return {};
  return fail(ErrorCode::kInsufficientData, "the heel is too narrow for a whole one",
              "scan the foot again, from all sides");
}

Result<void> check_arch(double height_mm) {
  if (height_mm >= kLeastArchMm) return {};
  return fail(ErrorCode::kInsufficientData,
              "the underside is flat: a flat foot, or a sole that was closed without being seen",
              "scan with a camera under the glass");
}

/// Of the foot itself only: redraws that fell out would hide how uncertain a measure is.
Result<void> check_sane(const LengthDefinition& definition, double length, const FootScan& foot) {
  if (definition.length == heel_breadth) return check_heel(length, foot);
  if (definition.length == arch_height) return check_arch(length);
  return {};
}

Result<Measure> take(const LengthDefinition& definition, const FootScan& foot,
                     const FootDoubts& about) {
  const auto length = definition.length(foot.landmarks);
  if (!length) return tl::unexpected(length.error());
  if (auto sane = check_sane(definition, *length, foot); !sane) {
    return tl::unexpected(sane.error());
  }
  Measure measure;
  measure.id = definition.id;
  const auto by_landmarks = u95_by_landmarks(definition, foot, about);
  if (!by_landmarks) return tl::unexpected(by_landmarks.error());
  const auto to_other = distance_to_other_foot(definition, *length, foot);
  if (!to_other) return tl::unexpected(to_other.error());
  std::optional<double> u95 = *by_landmarks;
  if (u95 && !foot.is_floor_known) u95 = std::hypot(*u95, definition.floor_doubt_mm);
  if (u95) {
    measure.parts = widened({about.shared.of(definition.length), *u95}, *to_other);
    u95 = std::hypot(measure.parts->surface, measure.parts->landmarks);
  }
  if (definition.kind == LengthDefinition::Kind::kAngle) {
    measure.value_mm = std::numeric_limits<double>::quiet_NaN();
    measure.value_deg = *length;
    measure.u95_deg = u95;
  } else {
    measure.value_mm = *length;
    measure.u95_mm = u95;
  }
  measure.definition = definition.words;
  measure.warnings = doubts(foot, definition.landmarks);
  if (about.ends && definition.length == foot_length) {
    measure.warnings.push_back(about.ends->warning);
  }
  return measure;
}

std::string not_seen_below(double height_mm) {
  return "the wall of the foot was not seen below " + in_millimetres(height_mm) + " over the floor";
}

constexpr const char* kShowThatSide = "scan one foot alone, or with a camera on that side";

Result<void> check_wall(const HiddenWall& hidden) {
  if (hidden.share <= kMostHiddenShare) return {};
  return fail(ErrorCode::kInsufficientData,
              not_seen_below(hidden.height_mm) + ", most of the way down", kShowThatSide);
}

Result<void> check_share(double girth_mm, const FootScan& foot) {
  const auto length = foot_length(foot.landmarks);
  if (!length) return tl::unexpected(length.error());
  const double share = girth_mm / *length;
  if (share >= kLeastGirthShare && share <= kMostGirthShare) return {};
  return fail(ErrorCode::kInsufficientData, "the surface there is no foot's",
              "scan again, with the foot in full view of all cameras");
}

Result<Measure> take(const GirthDefinition& definition, const FootScan& foot,
                     const FootDoubts& about, const MeasureOptions& options) {
  const auto plane = definition.tape(foot.landmarks);
  if (!plane) return tl::unexpected(plane.error());
  auto girth = girth_in(*plane, foot, options);
  if (!girth) return tl::unexpected(girth.error());
  if (auto sane = check_share(girth->stretched_mm, foot); !sane) {
    return tl::unexpected(sane.error());
  }
  Measure measure;
  measure.id = definition.id;
  measure.value_mm = girth->stretched_mm;
  const HiddenWall hidden =
      foot.cloud.stands_on_platform() ? hidden_wall(about.seen, *plane, *girth) : HiddenWall{};
  if (auto seen = check_wall(hidden); !seen) return tl::unexpected(seen.error());
  // The tape's own interval alone, without that of the landmarks that place the tape, would promise
  // too much.
  const auto by_landmarks = u95_by_landmarks(definition, foot, about);
  if (!by_landmarks) return tl::unexpected(by_landmarks.error());
  const auto to_other = distance_to_other_foot(definition, girth->stretched_mm, foot, options);
  if (!to_other) return tl::unexpected(to_other.error());
  if (*by_landmarks && girth->stretched_u95_mm) {
    FloorBelow floor = foot.floor_below;
    floor.u95_mm += below_last_line_mm(foot);
    const double unseen = std::hypot(doubt_of_guessed_skin(foot.cloud, *plane), hidden.doubt_mm,
                                     doubt_of_deeper_sole(floor, *plane, *girth));
    measure.parts =
        widened({std::hypot(*girth->stretched_u95_mm, unseen), **by_landmarks}, *to_other);
    measure.u95_mm = std::hypot(measure.parts->surface, measure.parts->landmarks);
  }
  measure.plane = *plane;
  measure.definition = definition.words;
  measure.warnings = doubts(foot, definition.landmarks);
  measure.warnings.insert(measure.warnings.end(), girth->warnings.begin(), girth->warnings.end());
  if (hidden.doubt_mm > kWorthSayingMm) {
    measure.warnings.push_back(not_seen_below(hidden.height_mm) + ": " + kShowThatSide);
  }
  measure.girth = *std::move(girth);
  return measure;
}

void keep(MeasureSet& set, const FootScan& foot, const std::string& id, bool is_last,
          Result<Measure> measure) {
  if (measure) {
    if (auto useless = why_useless(*measure, foot)) {
      set.withheld.push_back({id, *std::move(useless)});
    } else {
      set.measures.push_back(*std::move(measure));
    }
  } else if (is_last && is_of_feet_only(id)) {
    set.withheld.push_back({id, "a shoe last has none"});
  } else {
    set.withheld.push_back({id, measure.error().line()});
  }
}

}  // namespace

Result<MeasureSet> measure_foot(const FootScan& foot, const MeasureOptions& options,
                                const GoOn& go_on) {
  for (const char* name : {"pternion", "acropodion"}) {
    if (!foot.landmarks.contains(name)) {
      return fail(ErrorCode::kInvalidInput, std::string("the foot has no landmark ") + name,
                  "align it and find its landmarks first");
    }
  }
  MeasureSet set;
  const bool is_last = is_shoe_last(foot);
  const FootDoubts about(foot);
  for (const auto& definition : length_definitions(foot)) {
    keep(set, foot, definition.id, is_last, take(definition, foot, about));
    if (!go_on()) return cancelled();
  }
  const auto definitions = girth_definitions(foot);
  std::vector<std::optional<Result<Measure>>> girths(definitions.size());
  std::atomic<bool> wanted = true;
  while_wanted(options.workers, go_on, wanted)(definitions.size(), [&](std::size_t i) {
    girths[i] = take(definitions[i], foot, about, options);
  });
  if (!wanted) return cancelled();
  for (std::size_t i = 0; i < definitions.size(); ++i) {
    keep(set, foot, definitions[i].id, is_last, *std::move(girths[i]));
  }
  return set;
}

}  // namespace instep
