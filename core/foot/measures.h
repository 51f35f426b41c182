#pragma once

#include <functional>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"
#include "core/girth/girth.h"
#include "core/go_on.h"
#include "core/result.h"
#include "core/workers.h"

namespace instep {

/// How a girth is taken in a plane.
using GirthMethod =
    std::function<Result<Girth>(const PointCloud&, const TapePlane&, const GirthOptions&)>;

struct MeasureOptions {
  GirthMethod girth = girth_by_rbf;
  Workers workers = one_after_the_other;  ///< does the girths; the measures are the same with any
};

/// All measures of an aligned foot with its landmarks, in a fixed order: the lengths, breadths,
/// heights and angles of core/foot/measures/foot_lengths.h, then `ball_girth`, `waist_girth`,
/// `instep_girth`, `short_heel_girth`, `long_heel_girth`, `ankle_girth`. Each carries the sentence
/// that defines it and a 95 % interval with its two parts; a girth its plane and its section as
/// well.
///
/// The part of the landmarks is how a measure scatters over FootScan::redraws, a girth's by tapes
/// laid round the same points, widened for what all redraws share, and with what it moves by where
/// a landmark lies each of Landmark::deviations_off_mm; where the side is not sure, it makes
/// the interval reach as far beyond the value that the other foot would have. That of the surface
/// is Girth's own, a length's what the cloud's shared errors do
/// (core/foot/measures/shared_doubt.h). Neither knows of a rule that is not what was meant.
///
/// A measure that cannot be had honestly is left out, and MeasureSet::withheld says why; so is one
/// whose interval is wider, to either side, than an eighth of it and 5 mm, or than 10 degrees: the
/// foot's length alone says as much (core/foot/measures/useless_measure.h). The length itself may
/// be so too, and then there are no sizes; where the skin of the toes or the heel runs on and only
/// the points end, or has a hole, it says so, and all intervals hold what another 10 mm of foot
/// along its axis would change (core/foot/measures/unseen_ends.h). One that leans on a doubtful
/// landmark carries a warning. Fails with kInvalidInput if the foot has no pternion or acropodion.
/// A left foot has the measures of its mirror image. The cost is that of the girths, twice where
/// the side is not sure; `go_on` hears of each measure, and once it returns false the whole fails
/// with kCancelled.
Result<MeasureSet> measure_foot(const FootScan& foot, const MeasureOptions& options = {},
                                const GoOn& go_on = always);

}  // namespace instep
