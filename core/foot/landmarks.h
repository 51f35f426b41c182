#pragma once

#include "core/foot/foot_scan.h"
#include "core/go_on.h"
#include "core/result.h"
#include "core/workers.h"

namespace instep {

/// Adds to an aligned foot the points of anatomy that its measures hang on. Each carries the rule
/// that found it and a confidence; where the shape gives no clear answer the point stands at the
/// fraction of the foot's length (FL) that feet have on average, or close to it, with a confidence
/// of 0.3 to 0.35 and a warning that names it. The outline is what lies up to 25/260 FL above the
/// floor; millimetres below are those of a foot of 260 mm, and in proportion on any other
/// (full_size.h), but for the place of the heel's breadth.
///
/// | name                       | rule                                                          |
/// |----------------------------|---------------------------------------------------------------|
/// | `metatarsale_tibiale`      | most medial point of the outline in 0.60-0.80 FL, weighed by  |
/// |                            | nearness to 0.69                                              |
/// | `metatarsale_fibulare`     | most lateral point in 0.50-0.75 FL, at least 15 mm behind the |
/// |                            | metatarsale tibiale, weighed by nearness to 0.63              |
/// | `ball_medial`, `_lateral`  | most medial and most lateral point in 0.50-0.85 FL; no less   |
/// |                            | far out than the two above where a border was not seen        |
/// | `ball_top`                 | highest point of the section over the two metatarsal points   |
/// | `instep_point`             | ridge of the foot's back at 0.50 FL                           |
/// | `lateral_midfoot`          | point of the lateral outline in 0.25-0.45 FL nearest to the   |
/// |                            | instep point in floor projection                              |
/// | `medial_arch`              | point of the medial outline in 0.35-0.60 FL whose plane with  |
/// |                            | the two above has the shortest tape; else 0.48 FL             |
/// | `arch_point`               | highest place of the underside in 0.35-0.60 FL, a quarter of  |
/// |                            | the breadth from the medial border                            |
/// | `heel_medial`, `_lateral`  | the outline at FL / 6                                         |
/// | `heel_breadth_medial`,     | the outline where FootScan::rules have the heel's breadth     |
/// | `heel_breadth_lateral`     | taken                                                         |
/// | `heel_point`               | point of the heel's side view furthest from the instep point  |
/// | `junction`                 | point of the back's side view nearest to the heel point, where|
/// |                            | leg and foot meet                                             |
/// | `medial_malleolus`         | most medial point at 0.22-0.38 FL over the floor              |
/// | `toe1_tip`, `toe1_top`     | foremost point in the medial 0.30 of the ball's breadth; the  |
/// |                            | highest 15 mm behind it                                       |
/// | `toe1_contact`,            | where a ruler laid on the ball's point touches the first and  |
/// | `toe5_contact`             | the little toe                                                |
///
/// The points of the ball, the malleolus and the pternion's place across are told by one surface
/// through all points near by (core/foot/skin/border_crest.h), so that they wander little with
/// noise.
///
/// Weighed: a millimetre further out makes up for 0.04 FL off the average place. So the place does
/// not jump with the sampling where a border is nearly straight; how much of it the border says and
/// how much the average is the confidence.
///
/// Radii, and what the measures' intervals need (FootScan::redraws), come from redraw_landmarks().
///
/// A landmark for which the cloud has no points at all, or only the rim of a hole (skin_round.h),
/// is left out, with a warning; measures that need it are then withheld. Fails with kInvalidInput
/// if `foot` lacks the landmarks of align_foot(). O(n), most of it for the redraws;
/// tests/bench/feet prints the time.
Result<FootScan> find_landmarks(FootScan foot);

/// The same, of which `workers` do the redraws, some milliseconds each; with any of them the
/// landmarks are the same.
Result<FootScan> find_landmarks_by(const Workers& workers, FootScan foot,
                                   const GoOn& go_on = always);

/// The rules alone, without redraws and radii.
void mark(FootScan& foot);

}  // namespace instep
