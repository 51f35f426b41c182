#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "core/foot/skin/skin_border.h"

namespace instep {

/// What is usual of a border round its crest.
struct UsualBorder {
  double along = 0.0;          ///< the usual place
  double half_width_mm = 0.0;  ///< > 0: the border is a curve of third order so far to either side
  double from = 0.0;           ///< the crest is looked for from there
  double to = 0.0;             ///< to there; the usual place is between
  /// Of the reach by the place, there: first to third, per mm each time, and their spreads between
  /// feet, > 0.
  Eigen::Vector3d derivatives = Eigen::Vector3d::Zero();
  Eigen::Vector3d spreads = Eigen::Vector3d::Zero();
  /// Second derivative of what is taken off the reach for a place off the usual one; >= 0.
  double handicap_bend_per_mm = 0.0;
};

/// Where a border of which a part was not seen is told to be furthest, less the handicap.
struct HiddenCrest {
  SkinBorder::Place place;  ///< without its bend
  /// Where it lies instead if what the samples leave open is one standard deviation off; each for
  /// itself: along and outwards.
  std::array<Eigen::Vector2d, 2> deviations_off_mm = {};
  /// 1 where the samples alone tell the border's slope, 0 where only what is usual does.
  double told_share = 0.0;
};

/// Whether a border has no sample for 8 mm or longer between two places.
bool has_gap(const SkinBorder& border, double from, double to);

/// The furthest place of a border that may lie where it was not seen, as between two feet that
/// stand together, where each hides the other's wall: told by the most likely curve, by the samples
/// that were seen and by what is usual of feet, each by how sure it is (least squares with known
/// variances). The furthest of what is guessed below the rim lies in front of or behind it, where
/// the guess begins.
///
/// `told`: the samples that are on skin that was seen; `guessed`: these and, where points were put
/// below walls that were lost, all others, of which the furthest says how far out the border is, to
/// 3 mm, where no other does. Nothing where there are no samples near the usual place, or the curve
/// has no crest.
std::optional<HiddenCrest> hidden_crest(const SkinBorder& told, const SkinBorder& guessed,
                                        const UsualBorder& usual);

}  // namespace instep
