#pragma once

#include "sim/solids/blend.h"
#include "sim/solids/solid.h"

namespace instep {

/// A body like a shoe last for a right foot: a smooth upper that meets the sole in a sharp
/// featherline, the sole curved from a raised heel seat to the toe spring. Heel near the origin,
/// toe towards +x. About 265 mm long.
class LastSolid final : public Solid {
 public:
  LastSolid();

  double value(const Eigen::Vector3d& point) const override;
  Eigen::AlignedBox3d bounds() const override { return bounds_; }

 private:
  Blend upper_;
  Eigen::AlignedBox3d bounds_;
};

}  // namespace instep
