#pragma once

#include <optional>
#include <string>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"

namespace instep::test {

/// What a case was made of, to be told apart by afterwards.
struct CaseMaking {
  std::string body;      ///< "ellipse", "last", "foot", ...
  std::string sampling;  ///< "random", "even", "graded", "lines", "rings", "as given"
  double sigma_mm = 0.0;
  double hole_mm = 0.0;  ///< diameter, 0 for none
  bool normals_told = false;
  bool sigma_told = false;
};

/// A cloud, a tape plane through it, and both lengths of the girth there, known from elsewhere.
struct GirthCase {
  std::string name;
  CaseMaking making;
  PointCloud cloud;
  TapePlane plane;
  double stretched_mm;
  double contact_mm;
  /// Standard deviation of the best girth that white noise allows; nothing where it was not worked
  /// out.
  std::optional<double> floor_mm;
};

}  // namespace instep::test
