#pragma once

#include "sim/solids/blend.h"
#include "sim/solids/foot_parameters.h"
#include "sim/solids/solid.h"

namespace instep {

/// A foot and lower leg standing on z = 0: heel near the origin, toes towards +x, the medial side
/// of a right foot towards +y.
///
/// Bones with their flesh as round cones: five rays from the midfoot to the toes, heel, outer edge,
/// instep, ankle with both malleoli, leg. Their smooth union is pressed on the floor: flat where it
/// stands, with a round rim, the medial arch clear of the ground. A left foot is the mirror image
/// of the right one. The union is scaled along its axes to the asked length, breadth and height.
class FootSolid final : public Solid {
 public:
  /// `parameters` must have passed check_foot_parameters().
  explicit FootSolid(const FootParameters& parameters);

  double value(const Eigen::Vector3d& point) const override;
  Eigen::Vector3d gradient(const Eigen::Vector3d& point) const override;
  Eigen::AlignedBox3d bounds() const override { return bounds_; }
  const FootParameters& parameters() const { return parameters_; }

  /// The middle of the second toe's tip: anatomy that the skin alone does not always show.
  Eigen::Vector3d second_toe() const;

 private:
  double model_value(const Eigen::Vector3d& point) const;
  Eigen::Vector3d model_gradient(const Eigen::Vector3d& point) const;
  Eigen::Vector3d mirrored(const Eigen::Vector3d& point) const;
  void fit_scale();

  FootParameters parameters_;
  double rim_;  ///< radius, in the model
  Blend toes_;
  Blend body_;
  Eigen::Vector3d second_toe_;                       ///< in the model
  Eigen::Vector3d scale_ = Eigen::Vector3d::Ones();  ///< foot from model
  Eigen::AlignedBox3d bounds_;
};

}  // namespace instep
