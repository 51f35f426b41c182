#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// A line that a plane cuts out of a mesh, in the plane's own coordinates. A closed one does not
/// repeat its first point.
struct SectionLine {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
  /// Widest gap that was joined in it.
  double widest_seam = 0.0;

  /// Its own length, with the closing edge of a closed line.
  double length() const;
};

/// The lines with open ends that lie within `widest` of each other joined, nearest first, of one
/// line or of two: the seams of faces that were never stitched. The two ends of a line of two
/// points are not joined with each other. Open lines come first. O(points + ends log ends), where
/// ends do not crowd.
std::vector<SectionLine> stitched(std::vector<SectionLine> lines, double widest);

}  // namespace instep
