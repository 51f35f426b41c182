#pragma once

#include <vector>

#include "core/girth/contour/contour.h"

namespace instep {

/// What a closed line gains in length for each unit that a corner moves outwards: to first order
/// the angle (radians) by which the line turns there. One number for each corner.
struct ContourTurns {
  std::vector<double> contact;    ///< of the contour itself
  std::vector<double> stretched;  ///< of a tape round it, which turns only where it touches
};

ContourTurns turns_of(const Contour& contour);

/// How deep the hollows and folds of a contour go, on the mean: half of what it is longer than a
/// tape round it, for every full turn that it makes to and fro beyond the one round the body. Of
/// one that hardly turns more than that, more than any of its folds. `more`: what it is longer.
double mean_fold_depth(const Contour& contour, double more);

}  // namespace instep
