#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace instep {

/// The lines in which a scanner that was moved past a foot left its points: those of each lie on a
/// plane, and all planes are parallel.
struct ScannerLines {
  Eigen::Vector3d across = Eigen::Vector3d::UnitX();  ///< normal to the planes
  double pitch_mm = 0.0;                              ///< from plane to plane
  double first_mm = 0.0;  ///< where along `across` one of the planes is, from the origin
  double step_mm = 0.0;   ///< from point to point on a line, on the mean of skin that lies along it

  /// The number of the line that a point belongs to; negative ones too.
  long long line_of(const Eigen::Vector3d& point_mm) const;

  /// Whether points stand closer on each than the lines do, so that a line is no part of a sheet.
  bool are_apart() const { return step_mm < 0.8 * pitch_mm; }
};

/// Of lines far enough apart to matter, 1.2 mm at least, and 15 mm at most: those that are nearer
/// show a foot as well as points at random do; those further apart show none. Rows of
/// pixels are lines too where points stand a little closer on them than they do: an end that they
/// are level with may lie up to a row beyond the last.
///
/// The nearest neighbours of points on a line lie on it with them, so that of all ways to them none
/// leads off the planes; how far apart these are tells the wave along that way that most points
/// round a place are in step with (a periodogram). As told by some eighty places, of which
/// most must agree: lines whose noise is more than a sixth of the pitch, or a millimetre, are none
/// any more, and neither are those that run every way, as of a turntable. The pitch is good to a
/// hundredth if it is even, or else that of lines near each other.
///
/// The same in whatever order the points come. O(n log n), some 0.15 s for 200,000 points, of
/// which no more are asked.
std::optional<ScannerLines> scanner_lines(const std::vector<Eigen::Vector3d>& points_mm);

}  // namespace instep
