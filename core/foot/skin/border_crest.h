#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/foot/skin/skin_border.h"

namespace instep {

/// How much of the skin round a place is looked at, as half-widths > 0.
struct CrestPatch {
  double along_mm = 0.0;
  double across_mm = 0.0;
};

/// What is known beforehand of where a crest is: each spread off the usual place counts as so many
/// spreads' square of millimetres less reach.
struct UsualPlace {
  double along = 0.0;
  double spread_mm = 0.0;  ///< > 0
};

/// The place near `start` where a border reaches furthest, less what it is off its usual place,
/// told from one surface through all points of a patch.
///
/// A border's samples, each fitted on its own and then smoothed, spend most of what the points say
/// on each sample's own bend, and so its furthest place wanders with the noise two or three times
/// as far as it has to. Here a quadratic surface is fitted at once: what its crest wanders by falls
/// with the square root of the cube of the patch's length and of its width, until the border's own
/// bends pull it aside. What they pull by is mostly of third order; a longer patch tells that,
/// where it has enough points, and it is taken off first: over simulated scans the tibiale came
/// 0.35 mm too far back without. Points have less say towards the patch's limits, along and across,
/// and the further they are off the surface, so that none comes in or goes with a jump; strays have
/// none. A patch is laid round the crest of the last one until that stands still, twelve times at
/// the most: in one of twenty-five places on feet it is still under way then, mostly by less than a
/// tenth of a millimetre.
///
/// Nothing where the patch holds too few points, or none on one side of the place, or has no crest
/// within it, or where `start` lies beside the view by more than half of the patch. O(n).
std::optional<SkinBorder::Place> crest_near(const std::vector<Eigen::Vector3d>& points,
                                            const BorderView& view, const SkinBorder::Place& start,
                                            const CrestPatch& patch,
                                            const std::optional<UsualPlace>& usual = {});

}  // namespace instep
