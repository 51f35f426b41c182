#pragma once

#include <cstddef>
#include <vector>

#include "core/fusion/poses/bent_depths.h"
#include "core/fusion/poses/view_equations.h"
#include "core/fusion/poses/view_matches.h"
#include "core/fusion/views/shared_errors.h"
#include "core/geometry/rigid_transform.h"
#include "core/go_on.h"
#include "core/result.h"

namespace instep {

struct RegistrationSettings {
  std::size_t queries = 4000;  ///< points of a view that look for a match; a quarter at first
  ExpectedErrors expected;     ///< holds what the surfaces leave open
  /// The given poses are a place to begin and no evidence: the overlaps alone tell where the views
  /// stand, and what they leave open is as unknown as `expected` says.
  bool are_poses_rough = false;
  /// Variance of a normal's lean, each way (square radians), that is not to pass for a hold, see
  /// take_out_noise_of_normals(): for poses of which nothing else is known.
  double normal_variance = 0.0;
  double most_shift_mm = 60.0;  ///< a view that wants to go further does not fit
  /// Share of a view's queries with a match, or of another one's with a match in it.
  double least_overlap = 0.05;
  double most_residual_mm = 3.0;  ///< median of a view that fits
};

/// A lens or depth that is off by more is worth mending, as a share: of exact ones the fit makes at
/// most 0.07 % more or less, by poses that are off by 2 mm.
inline constexpr double kNotableStretch = 3e-3;

enum class ViewFit {
  kFits,
  kSlides,  ///< shares only surface along which it could slide, such as the platform
  kAlone,   ///< shares no surface with the others: nothing to check or refine its pose by
  kDoesNotFit,
};

struct RegisteredView {
  /// New station from given station, after the depths of the view have been multiplied by 1 +
  /// deeper and what lies across them by 1 + wider.
  RigidTransform correction = RigidTransform::Identity();
  double deeper = 0.0;
  double wider = 0.0;
  /// The pose's part of that, about the middle of what the view shows: for who moves it and
  /// stretches nothing.
  RigidTransform unstretched_correction = RigidTransform::Identity();
  /// What is left unknown of that: turns, shifts and stretches of what the camera sees, as moved
  /// and stretched, in its frame.
  std::vector<ErrorField> errors;
  ViewFit fit = ViewFit::kAlone;
  double moved_mm = 0.0;     ///< how far that moves a point of a foot, at most
  double overlap = 0.0;      ///< share of its queries with a match
  double residual_mm = 0.0;  ///< median distance to the matched surfaces, after
  /// Of the distances to them by the given poses, what the correction of the poses took away where
  /// it shows: their error across the skin, without the noise of the points.
  double taken_away_mm = 0.0;
};

struct Registration {
  std::vector<RegisteredView> views;
  /// Median over all matches, up to 10 mm apart, by the given poses and after.
  double residual_before_mm = 0.0;
  double residual_after_mm = 0.0;
  /// What the noise of the points does not explain of the distances, one sigma: errors of the
  /// poses, lenses and depths before, bent depths and the like after.
  double unexplained_before_mm = 0.0;
  double unexplained_after_mm = 0.0;
  BentDepths bent;  ///< as they show where they fit each other
};

/// Moves and stretches views against each other until their surfaces agree: all at once, each
/// iteration matching every view with every other and taking one Gauss-Newton step on the
/// point-to-plane distances (Chen and Medioni 1992; normals of both sides, Rusinkiewicz 2019), each
/// weighed by its noise, with Tukey weights whose reach shrinks from 30 mm to 5. Views whose result
/// breaks a limit are marked kDoesNotFit, those that share hardly anything kAlone; neither gets a
/// correction, and the others are solved again without them. One that is alone is taken to be as
/// right as they are.
///
/// The given poses and lenses weigh too, twice over: first as ill known as the settings say, then
/// as the overlaps have shown them to be (of lenses by a few rounds of Dempster, Laird and Rubin's
/// EM, 1977). So right ones stay what they are, and wrong ones do not drift where views hardly
/// overlap. A stretch is counted about the middle of what a view sees, not about its camera: a
/// wrong distance is a matter of the pose, for poses are found by the same lenses. What is common
/// to all views, the size of all together, no overlap shows: it is taken to be as right as the
/// views agree, as of lenses that err independently.
///
/// What is left unknown is told with each view: the covariance of the step, in which neighbouring
/// matches count as far fewer independent ones, turned into independent errors of all views.
///
/// What is left of the distances after that, as far as neighbours are alike in it, tells how bent
/// the depths are (bent_depths()).
///
/// Clouds are given in the station frame and need normals, sigma and view directions; one without
/// is kAlone. Deterministic. Costs some 100 ms for 4 views of good poses; each iteration is a piece
/// of the work for `go_on`. Fails with kCancelled alone.
Result<Registration> register_views(const std::vector<PosedCloud>& views,
                                    const RegistrationSettings& settings = {},
                                    const GoOn& go_on = always);

}  // namespace instep
