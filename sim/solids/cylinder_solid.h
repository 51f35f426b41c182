#pragma once

#include "sim/solids/solid.h"

namespace instep {

/// An upright round cylinder on z = 0, its axis the z axis, with flat ends and sharp edges: the
/// body whose girths are known in closed form.
class CylinderSolid final : public Solid {
 public:
  CylinderSolid(double radius_mm, double height_mm) : radius_(radius_mm), height_(height_mm) {}

  double value(const Eigen::Vector3d& point) const override;
  Eigen::AlignedBox3d bounds() const override;
  double radius_mm() const { return radius_; }

 private:
  double radius_;
  double height_;
};

}  // namespace instep
