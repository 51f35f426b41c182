#pragma once

#include <string>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"
#include "core/foot/shoe_sizes.h"
#include "core/girth/girth.h"

namespace instep {

/// What a person reads in a terminal (UTF-8, lines end with a newline): an aligned table of the
/// measures with their intervals, then what is missing, the sizes, and what to doubt.
std::string foot_text(const FootScan& foot, const MeasureSet& measures, const ShoeSizes& sizes);

/// One girth in a few lines; `method` is the name that the user gave.
std::string girth_text(const std::string& method, const Girth& girth);

}  // namespace instep
