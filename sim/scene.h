#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/rigid_transform.h"
#include "sim/solids/solid.h"

namespace instep {

/// A solid and where it stands.
struct PlacedSolid {
  std::shared_ptr<const Solid> solid;
  RigidTransform station_from_solid = RigidTransform::Identity();
};

/// The plate on which the customer stands: a box centred on the station's origin, its upper face
/// at z = 0. Beyond its edges a camera sees nothing.
struct Platform {
  double length_mm = 600.0;  ///< along x
  double width_mm = 600.0;   ///< along y
  double thickness_mm = 30.0;
};

/// All that a camera of the simulated station can see.
struct Scene {
  std::vector<PlacedSolid> solids;
  std::optional<Platform> platform = Platform{};
};

}  // namespace instep
