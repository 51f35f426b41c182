#include "core/foot/measures.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <string>
#include <utility>

#include "core/foot/foot_lengths.h"
#include "core/foot/foot_tapes.h"
#include "core/foot/standing_girth.h"

namespace instep {
namespace {

constexpr double kPoorConfidence = 0.35;
// Girths of feet are 0.85 to 1.2 of their length; far beyond that the surface went astray.
constexpr double kLeastGirthShare = 0.65;
constexpr double kMostGirthShare = 1.45;

struct LengthRule {
  const char* id;
  Result<double> (*length)(const FootScan&);
  std::vector<const char*> landmarks;
  const char* definition;
};

struct GirthRule {
  const char* id;
  Result<TapePlane> (*tape)(const FootScan&);
  std::vector<const char*> landmarks;
  const char* definition;
};

const std::vector<LengthRule>& length_rules() {
  static const std::vector<LengthRule> rules{
      {"foot_length",
       foot_length,
       {},
       "from the pternion to the foremost toe, parallel to the axis from the pternion to the tip "
       "of the second toe (pt_toe2)"},
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
  };
  return rules;
}

const std::vector<GirthRule>& girth_rules() {
  static const std::vector<GirthRule> rules{
      {"ball_girth",
       ball_tape,
       {"metatarsale_tibiale", "metatarsale_fibulare"},
       "stretched tape in the upright plane over metatarsale tibiale and fibulare"},
      {"waist_girth",
       waist_tape,
       {"metatarsale_tibiale", "metatarsale_fibulare", "instep_point", "medial_arch"},
       "stretched tape in the plane midway between those of the ball and the instep girth"},
      {"instep_girth",
       instep_tape,
       {"instep_point", "lateral_midfoot", "medial_arch"},
       "stretched tape over the instep point at 0.50 of the foot's length, by the lateral midfoot "
       "and the point of the medial arch that makes it shortest"},
  };
  return rules;
}

std::vector<std::string> doubts(const FootScan& foot, const std::vector<const char*>& landmarks) {
  std::vector<std::string> warnings;
  for (const char* name : landmarks) {
    const auto found = foot.landmarks.find(name);
    if (found != foot.landmarks.end() && found->second.confidence < kPoorConfidence) {
      warnings.push_back(std::string(name) + " is placed by proportion");
    }
  }
  return warnings;
}

Result<Measure> take(const LengthRule& rule, const FootScan& foot) {
  const auto length = rule.length(foot);
  if (!length) return tl::unexpected(length.error());
  Measure measure;
  measure.id = rule.id;
  measure.value_mm = *length;
  measure.definition = rule.definition;
  measure.warnings = doubts(foot, rule.landmarks);
  return measure;
}

bool stands_on_platform(const PointCloud& cloud) {
  return std::any_of(cloud.origins.begin(), cloud.origins.end(),
                     [](PointOrigin origin) { return origin == PointOrigin::kPlatform; });
}

Result<void> check_share(double girth_mm, const FootScan& foot) {
  const auto length = foot_length(foot);
  if (!length) return tl::unexpected(length.error());
  const double share = girth_mm / *length;
  if (share >= kLeastGirthShare && share <= kMostGirthShare) return {};
  return fail(ErrorCode::kInsufficientData, "the surface there is no foot's",
              "scan again, with the foot in full view of all cameras");
}

Result<Measure> take(const GirthRule& rule, const FootScan& foot, const MeasureOptions& options) {
  const auto plane = rule.tape(foot);
  if (!plane) return tl::unexpected(plane.error());
  auto girth = options.girth(foot.cloud, *plane, options.girth_options);
  if (!girth) return tl::unexpected(girth.error());
  if (stands_on_platform(foot.cloud)) girth = standing_girth(*std::move(girth), *plane);
  if (auto sane = check_share(girth->stretched_mm, foot); !sane) {
    return tl::unexpected(sane.error());
  }
  Measure measure;
  measure.id = rule.id;
  measure.value_mm = girth->stretched_mm;
  // The tape's own interval is left out: alone, without that of the landmarks that place the tape,
  // it would promise too much.
  measure.plane = *plane;
  measure.definition = rule.definition;
  measure.warnings = doubts(foot, rule.landmarks);
  measure.warnings.insert(measure.warnings.end(), girth->warnings.begin(), girth->warnings.end());
  measure.girth = *std::move(girth);
  return measure;
}

void keep(MeasureSet& set, const char* id, Result<Measure> measure) {
  if (measure) {
    set.measures.push_back(*std::move(measure));
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
  for (const auto& rule : length_rules()) {
    keep(set, rule.id, take(rule, foot));
    if (!go_on()) return cancelled();
  }
  const auto& rules = girth_rules();
  std::vector<std::optional<Result<Measure>>> girths(rules.size());
  std::atomic<bool> wanted = true;
  options.workers(rules.size(), [&](std::size_t i) {
    if (!wanted) return;
    girths[i] = take(rules[i], foot, options);
    if (!go_on()) wanted = false;
  });
  if (!wanted) return cancelled();
  for (std::size_t i = 0; i < rules.size(); ++i) keep(set, rules[i].id, *std::move(girths[i]));
  return set;
}

}  // namespace instep
