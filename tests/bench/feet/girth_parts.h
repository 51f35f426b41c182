#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"
#include "tests/support/cases/drawn_feet.h"

namespace instep::bench {

/// Where the error of a girth comes from, by measuring each part apart from the other, mm.
struct GirthParts {
  /// The solid's own girth in the plane that was found, less that in the true one: landmarks.
  double plane = 0.0;
  /// The girth of the scan in the true plane, less the solid's: surface, and the floor under it.
  double surface = 0.0;
};

/// By the girths' names; one without a section is left out. Cost: some 50 ms a girth.
std::map<std::string, GirthParts> girth_parts(const test::DrawnFoot& drawn, std::uint64_t seed,
                                              const FootScan& foot, const MeasureSet& set);

}  // namespace instep::bench
