#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/geometry/rigid_transform.h"
#include "sim/solids/solid.h"

namespace instep {

/// Where `function` is largest between `low` and `high`: looks every `step`, then narrows the best
/// place by golden section to 1e-4.
double place_of_maximum(const std::function<double(double)>& function, double low, double high,
                        double step);

/// Feels a solid from outside with straight needles, in a frame of the caller's choice whose z = 0
/// is the floor. Its outline is the shadow on the floor of what lies up to a height.
/// Results are good to about 1e-4 mm.
class OutlineProbe {
 public:
  OutlineProbe(const Solid& solid, const RigidTransform& solid_from_frame, double outline_height_mm)
      : solid_(solid), solid_from_frame_(solid_from_frame), outline_height_mm_(outline_height_mm) {}

  double value(const Eigen::Vector3d& point) const {
    return solid_.value(solid_from_frame_ * point);
  }

  /// The outermost point of the outline on the line x = `station`, towards +y (`sign` +1) or -y.
  Eigen::Vector3d side(double station, double sign) const;

  /// The outermost point on the line y = `offset`, towards +x (`sign` +1) or -x.
  Eigen::Vector3d end(double offset, double sign) const;

  /// How far the body reaches along a line through `centre`, felt from outside; far below zero if
  /// the line misses it.
  double reach(const Eigen::Vector3d& centre, const Eigen::Vector3d& direction) const;

  /// The outermost point of the body's side view (its shadow along y) on the ray from `centre` in
  /// `direction`, which has no y; lines up to `half_width` beside y = 0 are felt.
  Eigen::Vector3d profile(const Eigen::Vector3d& centre, const Eigen::Vector3d& direction,
                          double half_width) const;

  /// The lower skin at `station` and `offset`, felt from below.
  Eigen::Vector3d underside(double station, double offset) const;

  /// The upper skin above `station` and `offset`, reached from within the body at height `from`:
  /// what hangs over it does not count. z = 0 if that start is not within the body.
  Eigen::Vector3d top(double station, double offset, double from) const;

 private:
  Eigen::Vector3d outermost(const Eigen::Vector3d& centre, const Eigen::Vector3d& direction) const;

  const Solid& solid_;
  RigidTransform solid_from_frame_;
  double outline_height_mm_;
};

}  // namespace instep
