#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/surface/heights/height_base.h"
#include "core/surface/oriented_point.h"

namespace instep {

/// As many samples as a patch is fitted to; more points are averaged first.
inline constexpr int kMostHeightSamples = 64;

/// Points of a small piece of surface as heights over a base, in unit scale.
struct HeightSamples {
  Eigen::Matrix2Xd places;    ///< on the base
  Eigen::VectorXd heights;    ///< over it
  Eigen::VectorXd variances;  ///< of the heights
  Eigen::Matrix2Xd slopes{};  ///< of the surface there; no columns where they are not known

  Eigen::Index size() const { return heights.size(); }
  bool has_slopes() const { return slopes.cols() > 0; }
};

/// With slopes if the base is a plane, all normals are told and the points are few enough not to
/// be averaged.
HeightSamples samples_over(const std::vector<OrientedPoint>& points, const HeightBase& base);

/// Coefficients of 1, x, y, xx, xy, yy.
using Quadratic = Eigen::Matrix<double, 6, 1>;

/// Of those, and of xxx, xxy, xyy, yyy.
using Polynomial = Eigen::Matrix<double, 10, 1>;

/// Over the base, at a place on it.
inline double height_of(const Quadratic& c, const Eigen::Vector2d& place) {
  const double x = place.x();
  const double y = place.y();
  return c[0] + x * (c[1] + x * c[3] + y * c[4]) + y * (c[2] + y * c[5]);
}

/// The first `terms` (3, 6 or 10) of those monomials, one place a row.
Eigen::MatrixXd monomials(const Eigen::Matrix2Xd& places, Eigen::Index terms);

/// Their slopes along x at all places, then along y.
Eigen::MatrixXd monomial_slopes(const Eigen::Matrix2Xd& places, Eigen::Index terms);

/// The quadratic that fits best; of many that do, as of samples on one or two lines, that which is
/// least steep and bends least, whichever way the axes lie. At least six samples.
Quadratic least_squares(const HeightSamples& samples);
/// Nothing if the samples hardly determine it, such as those on a line or two. Any number.
std::optional<Quadratic> determined_quadratic(const HeightSamples& samples);

/// Samples of which each is the average of those in one cell.
struct CellAverages {
  HeightSamples samples;
  std::vector<Eigen::Index> cells;  ///< for each of those that came, the average it went into
  Eigen::VectorXd shares;           ///< for each of those that came, its part in that average
};

/// What is left of the heights over `trend`, averaged over square cells, weighted by certainty: at
/// most 49 averages, however many came. As the trend is taken out first, a cell's average is not
/// bent by the curvature of the surface across it.
CellAverages averaged_rest(const HeightSamples& samples, const Quadratic& trend);

}  // namespace instep
