#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/geometry/scan_lines.h"

namespace instep {

/// The lines in which a scanner that was moved past a foot left its points, if they are on parallel
/// planes and far enough apart to matter: 1.2 mm at least, 7 mm at most. Those that are nearer show
/// a foot as well as points at random do; those further apart show none.
///
/// Nothing of lines of fewer than some four points to a gap, or thick with noise. The same in
/// whatever order the points come. O(n log n), a tenth of a second for 200,000 points, of which no
/// more are asked.
std::optional<ScanLines> scanner_lines(const std::vector<Eigen::Vector3d>& points_mm);

}  // namespace instep
