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

/// The lines with open ends that lie within `widest` of each other joined, of one line or of two:
/// the seams of faces that were never stitched. The nearest come first, as far as they differ by
/// more than a few times; a line's own ends are joined where the gap is no more than a quarter of
/// what it closes. Lines without length are left out; open ones come first. O(points + ends log
/// ends), where ends do not crowd.
std::vector<SectionLine> stitched(std::vector<SectionLine> lines, double widest);

}  // namespace instep
