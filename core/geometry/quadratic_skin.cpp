#include "core/geometry/quadratic_skin.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/median.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

using Terms = Eigen::Matrix<double, 6, 1>;

constexpr std::size_t kFewestPoints = 8;

Terms terms(double x, double y) {
  return (Terms() << 1.0, x, y, x * x, x * y, y * y).finished();
}

std::optional<Terms> fitted(const SkinPatch& points, const Terms* first, double limit) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Terms right = Terms::Zero();
  std::size_t used = 0;
  for (const auto& point : points) {
    const Terms row = terms(point.x(), point.y());
    if (first != nullptr && std::abs(point.z() - first->dot(row)) > limit) continue;
    // Of so few terms the whole square is quicker than a triangle of it.
    normal.noalias() += row * row.transpose();
    right += point.z() * row;
    ++used;
  }
  if (used < kFewestPoints) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> solver(normal);
  if (!(solver.rcond() > 1e-12)) return std::nullopt;
  const Terms solution = solver.solve(right);
  if (!solution.allFinite()) return std::nullopt;
  return solution;
}

}  // namespace

std::optional<QuadraticSkin> QuadraticSkin::through(const SkinPatch& points, double texture) {
  const auto first = fitted(points, nullptr, 0.0);
  if (!first) return std::nullopt;
  std::vector<double> off;
  off.reserve(points.size());
  for (const auto& point : points) {
    off.push_back(std::abs(point.z() - first->dot(terms(point.x(), point.y()))));
  }
  const double limit = std::max(kThreeSigmasInMedians * median(std::move(off)), texture);
  QuadraticSkin skin;
  skin.coefficients_ = fitted(points, &*first, limit).value_or(*first);
  return skin;
}

double QuadraticSkin::at(double x, double y) const {
  return coefficients_.dot(terms(x, y));
}

}  // namespace instep
