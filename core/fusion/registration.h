#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/rigid_transform.h"
#include "core/go_on.h"
#include "core/result.h"

namespace instep {

struct RegistrationSettings {
  double first_reach_mm = 30.0;  ///< how far apart matching surfaces may be at the beginning
  double last_reach_mm = 5.0;    ///< and at the end
  int iterations = 40;
  std::size_t queries = 1000;   ///< points of a view that look for a match
  std::size_t targets = 10000;  ///< points of a view that can be matched
  /// How well the given poses are known: holds what the surfaces leave open.
  double pose_sigma_mm = 15.0;
  double pose_sigma_deg = 3.0;
  double most_shift_mm = 60.0;  ///< a view that wants to go further does not fit
  double most_turn_deg = 12.0;
  double least_overlap = 0.05;    ///< share of a view's queries with a match
  double most_residual_mm = 3.0;  ///< median of a view that fits
};

enum class ViewFit {
  kFits,
  kAlone,  ///< shares no surface with the others: nothing to check or refine its pose by
  kDoesNotFit,
};

struct RegisteredView {
  RigidTransform correction = RigidTransform::Identity();  ///< new station from given station
  ViewFit fit = ViewFit::kAlone;
  double overlap = 0.0;      ///< share of its queries with a match
  double residual_mm = 0.0;  ///< median distance to the matched surfaces, after
};

struct Registration {
  std::vector<RegisteredView> views;
  double residual_before_mm = 0.0;  ///< median over all matches of the given poses
  double residual_after_mm = 0.0;
};

/// Moves views against each other until their surfaces agree: all poses at once, each iteration
/// matching every view with every other and taking one Gauss-Newton step on the point-to-plane
/// distances (Chen and Medioni 1992; normals of both sides, Rusinkiewicz 2019), with Tukey weights
/// whose reach shrinks from first_reach_mm to last_reach_mm. Views whose result breaks a limit are
/// marked kDoesNotFit, get no correction, and the others are solved again without them.
///
/// Clouds are given in the station frame and need normals and view directions; one without is
/// kAlone. Deterministic. Costs some 20 ms an iteration for 8 views; each is a piece of the work
/// for `go_on`. Fails with kCancelled alone.
Result<Registration> register_views(const std::vector<PointCloud>& views,
                                    const RegistrationSettings& settings = {},
                                    const GoOn& go_on = always);

}  // namespace instep
