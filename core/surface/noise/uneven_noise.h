#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// What the heights round one place say of the noise there.
struct NoiseWitness {
  Eigen::Vector3d place;
  double expected = 0.0;  ///< variance > 0: what is usual for all places, or told of this one
  double variance = 0.0;  ///< the likeliest one there, whatever the shape
  /// How much likelier that one is than the expected one: twice the difference of the log
  /// likelihoods, each with the shape that goes best with it.
  double contradiction = 0.0;
};

/// The standard deviation of the noise round one place, against the expected one.
struct LocalNoise {
  Eigen::Vector3d place;
  double times = 1.0;
};

/// The noise of each place, where places plainly contradict that all have the usual one: one side
/// of a body that was seen at a grazing angle scatters several times as much as another. Nothing
/// where they do not, so that where one noise is enough there is one.
///
/// `witnesses` in the order in which they lie round the body, the last beside the first. If there
/// is one noise, contradictions are squares of a normal deviate, one on average (Wilks 1938). They
/// have to be several, and alike in neighbours: a crease, strays, or a bend that points are too few
/// for make large ones, but few together. So of each place and its three neighbours to both sides
/// the middle one counts, which leaves steps what they are; a stretch of fewer than four places is
/// not told apart. Over a step of up to five times the larger noise reaches by one place, for where
/// it ends is not known. Each logarithm is drawn to the common one first, as a normal prior would
/// do it.
std::vector<LocalNoise> uneven_noise(std::vector<NoiseWitness> witnesses);

/// The same where the noise is told: places that show less than is told of them have no say, for
/// neighbours may share a part of it, which does not show; the others have as much as they show.
std::vector<LocalNoise> noise_beyond_told(std::vector<NoiseWitness> witnesses);

/// The least noise (a standard deviation) that is not the texture of skin or rounding, for a body
/// as large as the places of `witnesses` lie apart.
double least_noise(const std::vector<NoiseWitness>& witnesses);

/// The root of the mean square over all of them. At least one is known.
double usual_times(const std::vector<LocalNoise>& known);

/// What is known at a place, from the nearest ones. At least one is known.
double times_at(const std::vector<LocalNoise>& known, const Eigen::Vector3d& place);

}  // namespace instep
