#include "core/surface/height_samples.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

namespace instep {
namespace {

constexpr int kCellsAcross = 8;
/// Stands for no variance at all where variances are divided by.
constexpr double kLeastVariance = 1e-18;

struct Cell {
  double weight = 0.0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  double height = 0.0;
};

std::size_t cell_at(const Eigen::Vector2d& place) {
  const auto step = [](double coordinate) {
    const int cell = static_cast<int>((coordinate + 1.0) * 0.5 * kCellsAcross);
    return static_cast<std::size_t>(std::clamp(cell, 0, kCellsAcross - 1));
  };
  return step(place.x()) * kCellsAcross + step(place.y());
}

}  // namespace

HeightSamples samples_over(const std::vector<OrientedPoint>& points, const Eigen::Matrix3d& axes,
                           const Eigen::Vector3d& centre, double radius) {
  const auto count = static_cast<Eigen::Index>(points.size());
  HeightSamples samples{Eigen::Matrix2Xd(2, count), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const OrientedPoint& point = points[static_cast<std::size_t>(i)];
    const Eigen::Vector3d local = axes * (point.position - centre) / radius;
    samples.places.col(i) = local.head<2>();
    samples.heights[i] = local.z();
    samples.variances[i] = point.variance / (radius * radius);
  }
  return samples;
}

Eigen::MatrixXd monomials(const Eigen::Matrix2Xd& places, Eigen::Index terms) {
  const Eigen::ArrayXd x = places.row(0).transpose();
  const Eigen::ArrayXd y = places.row(1).transpose();
  Eigen::MatrixXd values(places.cols(), terms);
  values.col(0).setOnes();
  values.col(1) = x;
  values.col(2) = y;
  if (terms == Quadratic::RowsAtCompileTime) {
    values.col(3) = x * x;
    values.col(4) = x * y;
    values.col(5) = y * y;
  }
  return values;
}

Quadratic least_squares(const HeightSamples& samples) {
  const Eigen::MatrixXd values = monomials(samples.places, Quadratic::RowsAtCompileTime);
  const Eigen::Matrix<double, 6, 6> normal = values.transpose() * values;
  const Quadratic data = values.transpose() * samples.heights;
  return normal.ldlt().solve(data);
}

HeightSamples averaged_rest(const HeightSamples& samples, const Quadratic& trend) {
  const Eigen::VectorXd rest =
      samples.heights - monomials(samples.places, Quadratic::RowsAtCompileTime) * trend;
  std::array<Cell, kCellsAcross * kCellsAcross> cells;
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    Cell& cell = cells[cell_at(samples.places.col(i))];
    const double weight = 1.0 / std::max(samples.variances[i], kLeastVariance);
    cell.weight += weight;
    cell.place += weight * samples.places.col(i);
    cell.height += weight * rest[i];
  }
  const auto used = std::partition(cells.begin(), cells.end(),
                                   [](const Cell& cell) { return cell.weight > 0.0; });
  const auto count = static_cast<Eigen::Index>(used - cells.begin());
  HeightSamples averages{Eigen::Matrix2Xd(2, count), Eigen::VectorXd(count),
                         Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Cell& cell = cells[static_cast<std::size_t>(i)];
    averages.places.col(i) = cell.place / cell.weight;
    averages.heights[i] = cell.height / cell.weight;
    averages.variances[i] = 1.0 / cell.weight;
  }
  return averages;
}

}  // namespace instep
