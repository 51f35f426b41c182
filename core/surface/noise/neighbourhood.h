#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/surface/heights/kriging_likelihood.h"
#include "core/surface/heights/tangent_view.h"

namespace instep {

/// The heights of points round a place over their own tangent plane, and what they tell of noise
/// and shape: restricted maximum likelihood with the kernel r^3, curvature taken out, which tells
/// white noise from wandering shape by its scale.
///
/// Lengths in a unit in which the body is about one long; a roughness is that of LocalRoughness.
struct Neighbourhood {
  double radius;
  KrigingLikelihood likelihood;  ///< in units of the radius
  double variance;               ///< the noise that fits best if the roughness may be anything

  /// No noise but that of rounding.
  bool is_exact() const;
  /// Twice the negative log likelihood, up to what depends on neither.
  double misfit(double of_variance, double of_roughness) const;
  /// The roughness that fits best at a given noise; the likelihood is flat where noise hides the
  /// shape, so it is held near `usual`, if that is known.
  double likely_roughness(double at_variance, std::optional<double> usual) const;
};

/// As `view` shows them. Nothing of too few. O(kMostInView^3).
std::optional<Neighbourhood> neighbourhood_of(const TangentView& view);

/// The most noise that a neighbourhood of the view could show, a variance: all that a quadratic
/// leaves over, as if none of it were shape. Costs a hundredth of one. Infinite of too few.
double most_variance_in(const TangentView& view);

/// Whether one polynomial passes through all points: none of them is off it by noise. Costs far
/// less than a neighbourhood.
bool is_plain(const TangentView& view);

/// The roughness of a plain view, which half of its points tell. Nothing of too few.
std::optional<double> roughness_of_plain(const TangentView& view);

}  // namespace instep
