#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fusion/views/witness.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/rigid_transform.h"
#include "core/go_on.h"
#include "core/result.h"
#include "core/workers.h"

namespace instep {

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
/// A view is sought turned by up to 40 degrees from how it is said to be, and with the middle of
/// what it shows up to 120 mm from that of what the others show, which they see from other sides.
/// One for whose best place less than a tenth of the asked spots speak stays where it is.
/// Deterministic. A pair of views takes some 0.3 s; each view is sought anew, among all that are
/// placed, until it is placed itself, so that the work grows with the cube of their number. The
/// views that wait are jobs for `workers`; `go_on` hears of each turn. Fails with kCancelled alone.
Result<std::vector<RigidTransform>> place_roughly(const std::vector<LevelView>& views,
                                                  const Workers& workers = one_after_the_other,
                                                  const GoOn& go_on = always);

}  // namespace instep
