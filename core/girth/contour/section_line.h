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

/// Which gaps between open ends count as seams of faces that were never stitched.
struct Seams {
  double widest = 0.0;
  /// Between the ends of one line, at most this part of what it closes; never of two points. A
  /// strip beside others that it belongs to would close on itself.
  double own = 0.25;
};

/// The lines with open ends joined over seams, of one line or of two. The nearest come first, as
/// far as they differ by more than a few times. Lines without length are left out; open ones come
/// first. O(points + ends log ends), where ends do not crowd.
std::vector<SectionLine> stitched(std::vector<SectionLine> lines, const Seams& seams);

}  // namespace instep
