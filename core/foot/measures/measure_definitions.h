#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/foot/foot_scan.h"
#include "core/foot/measuring_rules.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// What each measure of a foot is: the landmarks it goes by, its definition in words, and what
/// these leave open. How they are taken is told in measures.h.

/// A length, a breadth, a height or an angle, read off the landmarks alone.
struct LengthDefinition {
  std::string id;
  Result<double> (*length)(const Landmarks&);  ///< mm, or degrees of an angle
  std::vector<const char*> landmarks;
  std::string words;
  enum class Kind { kLength, kAngle } kind = Kind::kLength;
  double floor_doubt_mm = 0.0;  ///< of a height, where the floor is told by the sole alone
  /// What the patch that tells a landmark, or the cameras, pull it aside by, over drawn feet and
  /// simulated stations (tests/bench/feet, poses).
  double own_doubt_mm = 0.0;
};

/// A tape round the foot. The foot frame is that of the landmarks.
struct GirthDefinition {
  std::string id;
  std::function<Result<TapePlane>(const Landmarks&)> tape;
  std::vector<const char*> landmarks;
  std::string words;
  /// What the definition's own terms leave open where a landmark is told by a bend hardly seen, or
  /// by a patch so wide that it pulls the landmark aside: over drawn feet (tests/bench/feet), and
  /// not to be seen in the scatter of redraws.
  double own_doubt_mm = 0.0;
};

/// All of them, in the order of the results; with the doubt of a floor that noise may have sunk.
std::vector<LengthDefinition> length_definitions(const FootScan& foot);

/// As its rules have them; where the ball's tape is to be the shortest, it is sought on `foot`.
/// O(points) then.
std::vector<GirthDefinition> girth_definitions(const FootScan& foot);

/// Whether a shoe last has nothing of the measure: no scan brings it.
bool is_of_feet_only(const std::string& id);

}  // namespace instep
