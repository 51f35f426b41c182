#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/girth/girth.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// One measure of a foot.
struct Measure {
  std::string id;  ///< such as "ball_girth"; the list is in the README
  double value_mm = 0.0;
  std::optional<double> u95_mm;    ///< half-width of the 95 % interval, if there is one
  std::optional<TapePlane> plane;  ///< for a girth: foot frame
  std::optional<Girth> girth;      ///< for a girth: its section; value_mm is its stretched length
  std::string definition;          ///< the rule it follows, in a sentence
  std::vector<std::string> warnings;
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
