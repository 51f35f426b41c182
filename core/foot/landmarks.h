#pragma once

#include "core/foot/foot_scan.h"
#include "core/result.h"

namespace instep {

/// Adds to an aligned foot the points of anatomy that its measures hang on. Each carries the rule
/// that found it and a confidence; where the shape gives no clear answer the point stands at the
/// fraction of the foot's length (FL) that feet have on average, with confidence 0.3 and a warning
/// that names it. The outline is what lies up to 25 mm above the floor.
///
/// | name                    | rule                                                             |
/// |-------------------------|------------------------------------------------------------------|
/// | `metatarsale_tibiale`   | most medial point of the outline in 0.60-0.80 FL; else 0.69 FL   |
/// | `metatarsale_fibulare`  | most lateral point in 0.50-0.75 FL, at least 15 mm behind the    |
/// |                         | metatarsale tibiale; else 0.63 FL                                |
/// | `instep_point`          | ridge of the foot's back at 0.50 FL                              |
/// | `lateral_midfoot`       | point of the lateral outline in 0.25-0.45 FL nearest to the      |
/// |                         | instep point in floor projection                                 |
/// | `medial_arch`           | point of the medial outline in 0.35-0.60 FL whose plane with the |
/// |                         | two above has the shortest tape; else 0.48 FL                    |
///
/// Where the border beside the ball is nearly straight, the most protruding place is weighed by its
/// nearness to the average one, so that it does not jump with the sampling.
///
/// A landmark for which the cloud has no points at all is left out, with a warning; measures that
/// need it are then withheld. Fails with kInvalidInput if `foot` lacks the landmarks of
/// align_foot(). O(n).
Result<FootScan> find_landmarks(FootScan foot);

}  // namespace instep
