#pragma once

namespace instep {

/// The standard deviation of a normal spread, in medians of its absolute values.
inline constexpr double kSigmaInMedians = 1.4826;

/// Three standard deviations of a normal spread, in medians of its absolute values: what lies
/// further off is taken for a stray.
inline constexpr double kThreeSigmasInMedians = 4.5;

/// Half of a 95 % interval, in standard deviations.
inline constexpr double kDeviations = 1.96;

}  // namespace instep
