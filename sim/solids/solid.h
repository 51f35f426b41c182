#pragma once

#include <Eigen/Geometry>

namespace instep {

/// A body described by a function of space: negative inside, zero on the skin, positive outside.
/// Millimetres, in the solid's own frame, in which it stands on z = 0.
///
/// The value changes by at most 1.42 millimetres a millimetre, and so never exceeds 1.42 times the
/// distance to the skin: a ray that advances by 0.7 of it does not pass through a thin part.
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
