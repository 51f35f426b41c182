#pragma once

#include <vector>

#include "core/foot/alignment.h"
#include "core/foot/foot_scan.h"
#include "core/geometry/point_cloud.h"
#include "core/go_on.h"
#include "core/result.h"

namespace instep {

/// Aligns the feet that stand on a platform together (one or two clouds in one frame, told from
/// each other and from what else stands there), each as align_foot() does, and returns the left one
/// first.
///
/// Two feet that point roughly the same way, one 0.15 of a length aside of the other or more, are
/// told left from right by where they stand, as sure as that and both shapes together are: 2 % of
/// people are taken to stand with crossed feet. Where a shape clearly says otherwise that is a
/// warning, and where both do the side is as good as a coin. Other two keep what their shapes say;
/// if that is one side, with a warning: one of them is wrong, and each is as sure as its shape is
/// against the other's. A forced side applies to a single foot only. Fails as align_foot() does, if
/// it fails for one of them; of two the message says which.
Result<std::vector<FootScan>> align_feet(const std::vector<PointCloud>& clouds,
                                         const AlignmentOptions& options = {},
                                         const GoOn& go_on = always);

}  // namespace instep
