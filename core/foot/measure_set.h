#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/girth/girth.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// The two parts of a 95 % interval, which add as squares: what the fitted surface, and the errors
/// that many of its points share, leave open where the tape or the ruler lies, and what the
/// landmarks leave open about where that is. In the unit of the measure.
struct DoubtParts {
  double surface = 0.0;
  double landmarks = 0.0;
};

/// One measure of a foot: a length, or an angle.
struct Measure {
  std::string id;                   ///< such as "ball_girth"; the list is in the README
  double value_mm = 0.0;            ///< not a number for an angle
  std::optional<double> value_deg;  ///< for an angle only
  std::optional<double> u95_mm;     ///< half-width of the 95 % interval, if there is one
  std::optional<double> u95_deg;    ///< the same of an angle
  std::optional<DoubtParts> parts;  ///< of u95_mm or u95_deg
  std::optional<TapePlane> plane;   ///< for a girth: foot frame
  std::optional<Girth> girth;       ///< for a girth: its section; value_mm is its stretched length
  std::string definition;           ///< the rule it follows, in a sentence
  std::vector<std::string> warnings;

  /// In its own unit, millimetres or degrees.
  double value() const { return value_deg.value_or(value_mm); }
  std::optional<double> u95() const { return value_deg ? u95_deg : u95_mm; }
};

/// A measure that could not be had honestly.
struct WithheldMeasure {
  std::string id;
  std::string reason;
};

/// All measures of one foot, in a fixed order.
struct MeasureSet {
  std::vector<Measure> measures;
  std::vector<WithheldMeasure> withheld;  ///< no number rather than a wrong one

  const Measure* find(const std::string& id) const {
    for (const auto& measure : measures) {
      if (measure.id == id) return &measure;
    }
    return nullptr;
  }
};

}  // namespace instep
