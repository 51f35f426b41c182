#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace instep {

/// Triangles over shared corners, in millimetres. Indices are valid for `positions`. Nothing is
/// promised about closedness, orientation or manifoldness: real files have none of them.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  bool empty() const { return triangles.empty(); }
};

}  // namespace instep
