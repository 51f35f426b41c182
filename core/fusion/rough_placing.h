#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/fusion/witness.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/rigid_transform.h"
#include "core/go_on.h"
#include "core/result.h"
#include "core/workers.h"

namespace instep {

/// How far cameras may stand from where they are said to: what they show of an object is sought
/// turned by up to that, and with its middle so far from that of what is known of it already, which
/// others see from other sides.
struct RoughPlacing {
  double most_turn_deg = 40.0;
  double most_shift_mm = 120.0;
  double turn_step_deg = 5.0;
  double shift_step_mm = 12.0;
  /// How near a spot must lie to the other view's skin to agree with it, about, and how far before
  /// what that sees to contradict it; half of it at the end.
  double margin_mm = 12.0;
  std::size_t points = 200;      ///< of a view's skin that are asked about
  std::size_t best_kept = 8;     ///< places that are looked at closer
  double least_agreement = 0.1;  ///< of the asked points; set by eye, as all of these
};

/// A view that is level on the platform, and what it shows of the object.
struct LevelView {
  PosedDepth posed;
  PointCloud skin;  ///< in the station, with normals
};

/// Turns the views about z and shifts them along the platform until each sees the object where the
/// others see it: the new station from the given one, for each view. The one that shows most stays;
/// the others are placed one after the other, first whose place is plainest. A place is good where
/// the points of one view lie on the skin that the other shows, inclined as it is, and none is seen
/// through, both ways. Cameras face to face share too little for that.
///
/// A view for whose best place less than `least_agreement` of the asked spots speak stays where it
/// is. Deterministic. A pair of views takes some 0.3 s; each view is sought anew, among all that
/// are placed, until it is placed itself, so that the work grows with the cube of their number.
/// The views that wait are jobs for `workers`; `go_on` hears of each turn. Fails with kCancelled
/// alone.
Result<std::vector<RigidTransform>> place_roughly(const std::vector<LevelView>& views,
                                                  const RoughPlacing& settings = {},
                                                  const Workers& workers = one_after_the_other,
                                                  const GoOn& go_on = always);

}  // namespace instep
