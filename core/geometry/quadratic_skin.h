#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace instep {

/// Points near a place of the skin, each as two coordinates along the skin (x, y) from the place
/// and one outwards (z).
using SkinPatch = std::vector<Eigen::Vector3d>;

/// A quadratic surface z(x, y) by least squares, fitted a second time without the points that the
/// first fit finds far off.
class QuadraticSkin {
 public:
  /// What is no further off than this is never left out: the texture of skin.
  static constexpr double kTextureMm = 0.05;

  /// Nothing under 8 points, or where they lie in a line. `texture`: in the unit of the points.
  static std::optional<QuadraticSkin> through(const SkinPatch& points, double texture = kTextureMm);

  double at(double x, double y) const;

  /// Coefficients of 1, x, y, x^2, xy, y^2.
  const Eigen::Matrix<double, 6, 1>& coefficients() const { return coefficients_; }

 private:
  Eigen::Matrix<double, 6, 1> coefficients_;
};

}  // namespace instep
