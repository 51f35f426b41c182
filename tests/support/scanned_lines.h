#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace instep::test {

/// How a line scanner goes over an elliptic cylinder along z, from z = -100 to 100.
struct ScannedLines {
  double half_width;  ///< in x, of the cylinder
  double half_depth;  ///< in y
  bool round;         ///< lines lead round it, or else along it
  double apart;       ///< from line to line, of those along it as a rule
  double step;        ///< from point to point on a line, of those round it as a rule
  double sigma = 0.0;
  double strays = 0.0;  ///< share of the points that lie 1 to 3 mm off, inside or out

  std::vector<Eigen::Vector3d> positions(std::uint64_t seed) const;
};

}  // namespace instep::test
