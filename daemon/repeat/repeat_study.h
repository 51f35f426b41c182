#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/repeatability.h"
#include "core/result.h"

namespace instep {

/// One result that takes part in a study, as result.json or `instep measure` holds it.
struct StudiedResult {
  std::string name;  ///< for warnings: the file it came from
  nlohmann::json result;
};

/// One measure over all scans of a foot that have it.
struct RepeatedMeasure {
  std::string id;
  bool is_angle = false;  ///< degrees, else millimetres
  Repeatability figures;
  /// What the results themselves claim: the mean half-width of their 95 % intervals, if all have
  /// one. It should be about twice the standard deviation, or more where the scans share an error.
  std::optional<double> claimed_u95;
};

/// All scans of one side.
struct RepeatedFoot {
  std::string side;  ///< "left", "right"; "unknown" if the results do not say
  std::vector<std::string> scans;
  std::vector<RepeatedMeasure> measures;  ///< in the order of the first result
};

/// How well repeated scans of one foot (or of a left and a right one) agree.
struct RepeatStudy {
  std::vector<RepeatedFoot> feet;
  std::vector<std::string> warnings;
};

/// What ISO 20685-1 allows between a dimension of a foot from a scan and that of a trained
/// measurer.
inline constexpr double kIsoFootLimitMm = 2.0;

/// Puts the results side by side. Warns of what makes the figures doubtful: feet of both sides
/// (each is then taken by itself), measures that are missing in some scans, few scans, a result
/// given twice (which counts once), results of different stations or of different versions of the
/// software. Leaves out, with a warning, a measure that the results define differently. Fails with
/// kInvalidInput if there are no two results of one side, if one of them has no measures, or if
/// they name different axes.
Result<RepeatStudy> study_repeats(const std::vector<StudiedResult>& results);

}  // namespace instep
