#pragma once

#include <Eigen/Geometry>

namespace instep {

/// A body described by a function of space: negative inside, zero on the skin, positive outside.
/// Millimetres, in the solid's own frame, in which it stands on z = 0.
///
/// The value never exceeds the distance to the skin from outside (it changes by at most one
/// millimetre a millimetre), so that a ray may advance by it without passing through a thin part.
/// Immutable after construction; safe to read from many threads.
class Solid {
 public:
  virtual ~Solid() = default;

  virtual double value(const Eigen::Vector3d& point) const = 0;

  /// Slope of value(), by central differences unless a solid knows better. On the skin it points
  /// outward.
  virtual Eigen::Vector3d gradient(const Eigen::Vector3d& point) const;

  /// A box that holds the whole body.
  virtual Eigen::AlignedBox3d bounds() const = 0;

  /// Outward unit normal of the skin nearest to `point`.
  Eigen::Vector3d normal(const Eigen::Vector3d& point) const {
    return gradient(point).normalized();
  }
};

}  // namespace instep
