#include "core/surface/heights/height_samples.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>

#include "core/surface/heights/kriging_limits.h"

namespace instep {
namespace {

constexpr int kCellsAcross = 7;
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

/// Weight, against that of all samples, of being flat: what samples on one line or two leave open
/// rounding would tell else. With none, 20 of 960 girths of prisms and other bodies, all of them by
/// points in rows, differ between processors by up to 13 mm.
constexpr double kFlatness = 1e-9;

}  // namespace

HeightSamples samples_over(const std::vector<OrientedPoint>& points, const HeightBase& base) {
  const auto count = static_cast<Eigen::Index>(points.size());
  HeightSamples samples{Eigen::Matrix2Xd(2, count), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  if (base.is_plane() && points.size() <= kMostHeightSamples && all_tell_normals(points))
    samples.slopes.resize(2, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const OrientedPoint& point = points[static_cast<std::size_t>(i)];
    const auto spot = base.see(point.position);
    samples.places.col(i) = spot.place;
    samples.heights[i] = spot.height;
    samples.variances[i] = point.variance / (base.radius() * base.radius());
    if (samples.has_slopes()) samples.slopes.col(i) = base.slope_of(point.normal);
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
  if (terms >= Quadratic::RowsAtCompileTime) {
    values.col(3) = x * x;
    values.col(4) = x * y;
    values.col(5) = y * y;
  }
  if (terms == Polynomial::RowsAtCompileTime) {
    values.col(6) = x * x * x;
    values.col(7) = x * x * y;
    values.col(8) = x * y * y;
    values.col(9) = y * y * y;
  }
  return values;
}

Eigen::MatrixXd monomial_slopes(const Eigen::Matrix2Xd& places, Eigen::Index terms) {
  const Eigen::ArrayXd x = places.row(0).transpose();
  const Eigen::ArrayXd y = places.row(1).transpose();
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(2 * places.cols(), terms);
  auto along = slopes.topRows(places.cols());
  auto across = slopes.bottomRows(places.cols());
  along.col(1).setOnes();
  across.col(2).setOnes();
  if (terms >= Quadratic::RowsAtCompileTime) {
    along.col(3) = 2.0 * x;
    along.col(4) = y;
    across.col(4) = x;
    across.col(5) = 2.0 * y;
  }
  if (terms == Polynomial::RowsAtCompileTime) {
    along.col(6) = 3.0 * x * x;
    along.col(7) = 2.0 * x * y;
    across.col(7) = x * x;
    along.col(8) = y * y;
    across.col(8) = 2.0 * x * y;
    across.col(9) = 3.0 * y * y;
  }
  return slopes;
}

Quadratic least_squares(const HeightSamples& samples) {
  const Eigen::MatrixXd values = monomials(samples.places, Quadratic::RowsAtCompileTime);
  // Products of columns one by one: there are many samples and few terms.
  Eigen::Matrix<double, 6, 6> normal;
  Quadratic data;
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) normal(i, j) = values.col(i).dot(values.col(j));
    data[i] = values.col(i).dot(samples.heights);
  }
  const double flat = kFlatness * static_cast<double>(samples.size());
  // Bends as their matrix has them, so that the axes do not matter.
  const Quadratic flatness = flat * (Quadratic() << 0.0, 1.0, 1.0, 1.0, 0.5, 1.0).finished();
  normal.diagonal() += flatness;
  const auto factors = normal.ldlt();  // reads the lower triangle
  const Quadratic quadratic = factors.solve(data);
  // Gives back what that took of the terms that the samples do tell.
  return quadratic + factors.solve(flatness.cwiseProduct(quadratic));
}

std::optional<Quadratic> determined_quadratic(const HeightSamples& samples) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(kLeastDetermined);
  qr.compute(monomials(samples.places, Quadratic::RowsAtCompileTime));
  if (qr.rank() < Quadratic::RowsAtCompileTime) return std::nullopt;
  return qr.solve(samples.heights).eval();
}

CellAverages averaged_rest(const HeightSamples& samples, const Quadratic& trend) {
  std::array<Cell, kCellsAcross * kCellsAcross> cells;
  CellAverages averages;
  averages.cells.resize(static_cast<std::size_t>(samples.size()));
  averages.shares.resize(samples.size());
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    const std::size_t at = cell_at(samples.places.col(i));
    Cell& cell = cells[at];
    const double weight = 1.0 / std::max(samples.variances[i], kLeastVariance);
    cell.weight += weight;
    cell.place += weight * samples.places.col(i);
    cell.height += weight * (samples.heights[i] - height_of(trend, samples.places.col(i)));
    averages.cells[static_cast<std::size_t>(i)] = static_cast<Eigen::Index>(at);
    averages.shares[i] = weight;
  }
  std::array<Eigen::Index, kCellsAcross * kCellsAcross> order{};
  Eigen::Index count = 0;
  for (std::size_t at = 0; at < cells.size(); ++at) {
    if (cells[at].weight > 0.0) order[at] = count++;
  }
  averages.samples = {Eigen::Matrix2Xd(2, count), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (std::size_t at = 0; at < cells.size(); ++at) {
    const Cell& cell = cells[at];
    if (!(cell.weight > 0.0)) continue;
    averages.samples.places.col(order[at]) = cell.place / cell.weight;
    averages.samples.heights[order[at]] = cell.height / cell.weight;
    averages.samples.variances[order[at]] = 1.0 / cell.weight;
  }
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    Eigen::Index& at = averages.cells[static_cast<std::size_t>(i)];
    averages.shares[i] /= cells[static_cast<std::size_t>(at)].weight;
    at = order[static_cast<std::size_t>(at)];
  }
  return averages;
}

}  // namespace instep
