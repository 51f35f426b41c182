#include "core/foot/robust_extreme.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostExtreme = 5;
constexpr double kSummitRadiusMm = 6.0;
/// Deeper points are of another face: the sole behind the edge of a toe.
constexpr double kDeepestMm = 2.0;
constexpr std::size_t kFewestForSummit = 12;
constexpr double kLargestCorrectionMm = 2.5;

Vector3d median_of_furthest(const std::vector<Vector3d>& points, const Vector3d& direction) {
  const std::size_t count = std::min(kMostExtreme, points.size());
  std::vector<Vector3d> furthest(count);
  std::partial_sort_copy(
      points.begin(), points.end(), furthest.begin(), furthest.end(),
      [&](const Vector3d& a, const Vector3d& b) { return direction.dot(a) > direction.dot(b); });
  return furthest[count / 2];
}

/// Points near the summit in its own coordinates: two across, the third along the direction.
using LocalPoints = std::vector<Vector3d>;

using Quadratic = Eigen::Matrix<double, 6, 1>;

Quadratic terms(double a, double b) {
  return (Quadratic() << 1.0, a, b, a * a, a * b, b * b).finished();
}

Quadratic fit(const LocalPoints& local) {
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(local.size()), 6);
  Eigen::VectorXd reach(static_cast<Eigen::Index>(local.size()));
  for (std::size_t i = 0; i < local.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    matrix.row(row) = terms(local[i].x(), local[i].y()).transpose();
    reach(row) = local[i].z();
  }
  return matrix.colPivHouseholderQr().solve(reach);
}

double residual(const Quadratic& surface, const Vector3d& local) {
  return std::abs(local.z() - surface.dot(terms(local.x(), local.y())));
}

/// Fits twice, the second time without the points that the first fit finds far off.
Quadratic robust_fit(LocalPoints local) {
  const Quadratic first = fit(local);
  std::vector<double> residuals;
  for (const auto& point : local) residuals.push_back(residual(first, point));
  const double limit = std::max(4.0 * median(std::move(residuals)), 0.05);
  std::erase_if(local, [&](const Vector3d& point) { return residual(first, point) > limit; });
  return local.size() < kFewestForSummit ? first : fit(local);
}

/// Where the quadratic is highest: at its vertex if that is a summit near by, else at the start.
Eigen::Vector2d summit(const Quadratic& surface) {
  Eigen::Matrix2d hessian;
  hessian << 2.0 * surface(3), surface(4), surface(4), 2.0 * surface(5);
  const bool is_dome = hessian(0, 0) < 0.0 && hessian.determinant() > 1e-8;
  if (!is_dome) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d vertex = hessian.inverse() * Eigen::Vector2d(-surface(1), -surface(2));
  return vertex.norm() < 0.5 * kSummitRadiusMm ? vertex : Eigen::Vector2d::Zero();
}

double second_furthest(LocalPoints local) {
  std::nth_element(local.begin(), local.begin() + 1, local.end(),
                   [](const Vector3d& a, const Vector3d& b) { return a.z() > b.z(); });
  return local[1].z();
}

}  // namespace

Vector3d robust_extreme(const std::vector<Vector3d>& points, const Vector3d& direction) {
  const Vector3d start = median_of_furthest(points, direction);
  const Vector3d across = direction.unitOrthogonal();
  const Vector3d upright = direction.cross(across);
  LocalPoints local;
  for (const auto& point : points) {
    const Vector3d offset = point - start;
    if (offset.squaredNorm() > kSummitRadiusMm * kSummitRadiusMm) continue;
    if (direction.dot(offset) < -kDeepestMm) continue;
    local.emplace_back(across.dot(offset), upright.dot(offset), direction.dot(offset));
  }
  if (local.size() < kFewestForSummit) return start;

  const double furthest = second_furthest(local);
  const Quadratic surface = robust_fit(std::move(local));
  const Eigen::Vector2d top = summit(surface);
  // A summit beyond what was seen would be a guess of the quadratic.
  const double reach = std::min(surface.dot(terms(top.x(), top.y())), furthest);
  if (!(std::abs(reach) < kLargestCorrectionMm)) return start;
  return start + top.x() * across + top.y() * upright + reach * direction;
}

}  // namespace instep
