#include "core/surface/height_kriging.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace instep {
namespace {

/// Terms of the polynomial that the points determine less than this are left out.
constexpr double kLeastDetermined = 1e-3;
/// No sample outweighs the least certain one by more, or a certain one would leave the others no
/// say in how rough the surface is.
constexpr double kLargestScale = 1e3;

/// Sum of the kernels round `places` times `shares`, at each of `samples`.
Eigen::ArrayXd kernels_at(const Eigen::Matrix2Xd& samples, const Eigen::Matrix2Xd& places,
                          const Eigen::VectorXd& shares) {
  const Eigen::ArrayXd x = samples.row(0);
  const Eigen::ArrayXd y = samples.row(1);
  Eigen::ArrayXd squared(samples.cols());
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(samples.cols());
  for (Eigen::Index i = 0; i < shares.size(); ++i) {
    squared = (x - places(0, i)).square() + (y - places(1, i)).square();
    sum += shares[i] * squared * squared.sqrt();
  }
  return sum;
}

/// Its lower triangle; both sides scaled.
Eigen::MatrixXd kernel_between(const Eigen::Matrix2Xd& places, const Eigen::ArrayXd& scales) {
  const Eigen::Index count = places.cols();
  const Eigen::ArrayXd x = places.row(0);
  const Eigen::ArrayXd y = places.row(1);
  Eigen::MatrixXd kernel(count, count);
  Eigen::ArrayXd squared(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const Eigen::Index rest = count - j;
    squared.tail(rest) = (x.tail(rest) - x[j]).square() + (y.tail(rest) - y[j]).square();
    kernel.col(j).tail(rest) =
        scales[j] * scales.tail(rest) * squared.tail(rest) * squared.tail(rest).sqrt();
  }
  return kernel;
}

/// The symmetric matrix, whose lower triangle is given, times a few columns.
Eigen::MatrixXd both_triangles_times(const Eigen::MatrixXd& lower, const Eigen::MatrixXd& columns) {
  const Eigen::Index count = lower.cols();
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(count, columns.cols());
  for (Eigen::Index j = 0; j < count; ++j) {
    const Eigen::Index rest = count - j - 1;
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
      product(j, k) += lower.col(j).tail(rest + 1).dot(columns.col(k).tail(rest + 1));
      product.col(k).tail(rest) += columns(j, k) * lower.col(j).tail(rest);
    }
  }
  return product;
}

/// Takes a * b' + b * a' from the lower triangle.
void subtract_both_ways(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                        Eigen::MatrixXd& matrix) {
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    const Eigen::Index rest = matrix.cols() - j;
    for (Eigen::Index k = 0; k < a.cols(); ++k) {
      matrix.col(j).tail(rest) -= b(j, k) * a.col(k).tail(rest) + a(j, k) * b.col(k).tail(rest);
    }
  }
}

/// A quadratic along one line has as many terms as a plane.
bool span_a_plane(const Eigen::Matrix2Xd& places) {
  const Eigen::Matrix2Xd arms = places.colwise() - places.rowwise().mean();
  const Eigen::Matrix2d spread = arms * arms.transpose();
  const double middle = 0.5 * spread.trace();
  const double narrowest = middle - std::hypot(0.5 * (spread(0, 0) - spread(1, 1)), spread(0, 1));
  const auto widest = std::max(static_cast<double>(places.cols()), 2.0 * middle);
  return narrowest > kLeastDetermined * kLeastDetermined * widest;
}

}  // namespace

/// Gram's and Schmidt's way, the longest column first and each made square to the earlier ones
/// twice, so that rounding leaves nothing over.
void HeightKriging::span(Eigen::MatrixXd columns) {
  const Eigen::Index terms = columns.cols();
  std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  upper_ = Eigen::MatrixXd::Zero(terms, terms);
  double first = 0.0;
  Eigen::Index rank = 0;
  for (; rank < terms; ++rank) {
    Eigen::Index longest = 0;
    columns.rightCols(terms - rank).colwise().squaredNorm().maxCoeff(&longest);
    longest += rank;
    columns.col(rank).swap(columns.col(longest));
    upper_.col(rank).swap(upper_.col(longest));
    std::swap(order_[static_cast<std::size_t>(rank)], order_[static_cast<std::size_t>(longest)]);
    auto column = columns.col(rank);
    for (Eigen::Index k = 0; k < rank; ++k) {
      const double left = columns.col(k).dot(column);
      column -= left * columns.col(k);
      upper_(k, rank) += left;
    }
    const double length = column.norm();
    if (rank == 0) first = length;
    if (!(length > kLeastDetermined * first)) break;
    column /= length;
    upper_(rank, rank) = length;
    for (Eigen::Index k = rank + 1; k < terms; ++k) {
      upper_(rank, k) = column.dot(columns.col(k));
      columns.col(k) -= upper_(rank, k) * column;
    }
  }
  basis_ = columns.leftCols(rank);
}

std::optional<HeightKriging> HeightKriging::of(const HeightSamples& samples, Eigen::Index terms) {
  if (samples.size() < 4 || !span_a_plane(samples.places)) return std::nullopt;
  HeightKriging kriging;
  kriging.places_ = samples.places;
  const double most = samples.variances.maxCoeff();
  kriging.level_ = most;
  kriging.scales_ = Eigen::ArrayXd::Ones(samples.size());
  if (most > 0.0) {
    kriging.scales_ = (most / samples.variances.array()).sqrt().min(kLargestScale);
  }
  const Eigen::VectorXd scales = kriging.scales_;
  kriging.span(scales.asDiagonal() * monomials(samples.places, terms));
  const Eigen::MatrixXd& basis = kriging.basis_;
  const Eigen::Index rank = basis.cols();
  if (rank < 3 || rank >= samples.size()) return std::nullopt;

  kriging.reduced_ = kernel_between(samples.places, kriging.scales_);
  kriging.on_basis_ = both_triangles_times(kriging.reduced_, basis);
  const Eigen::MatrixXd square = basis.transpose() * kriging.on_basis_;
  const Eigen::MatrixXd off =
      kriging.on_basis_ - 0.5 * basis * (square + Eigen::MatrixXd::Identity(rank, rank));
  subtract_both_ways(off, basis, kriging.reduced_);
  kriging.heights_ = scales.asDiagonal() * samples.heights;
  kriging.free_heights_ = kriging.heights_ - basis * (basis.transpose() * kriging.heights_).eval();
  return kriging;
}

double HeightKriging::log_determined() const {
  return 2.0 * upper_.diagonal().head(basis_.cols()).array().log().sum() -
         2.0 * scales_.log().sum();
}

std::optional<HeightKriging::Solution> HeightKriging::solve(double ratio) const {
  Eigen::MatrixXd system = reduced_;
  system.diagonal().array() += ratio;
  auto cholesky = SmallCholesky::of(system);
  if (!cholesky) return std::nullopt;
  Solution solution;
  solution.ratio = ratio;
  solution.on_null_space = cholesky->solve(free_heights_);
  if (!solution.on_null_space.allFinite()) return std::nullopt;
  solution.log_volume =
      cholesky->log_volume() - static_cast<double>(basis_.cols()) * std::log(1.0 + ratio);
  solution.excess = free_heights_.dot(solution.on_null_space);
  solution.cholesky = std::move(*cholesky);
  return solution;
}

Eigen::VectorXd HeightKriging::weights(const Solution& solution) const {
  return scales_ * solution.on_null_space.array();
}

Quadratic HeightKriging::polynomial(const Solution& solution) const {
  const Eigen::Index rank = basis_.cols();
  const Eigen::VectorXd coefficients =
      upper_.topLeftCorner(rank, rank)
          .triangularView<Eigen::Upper>()
          .solve(basis_.transpose() * heights_ - on_basis_.transpose() * solution.on_null_space);
  Quadratic polynomial = Quadratic::Zero();
  for (Eigen::Index k = 0; k < rank; ++k) {
    polynomial[order_[static_cast<std::size_t>(k)]] = coefficients[k];
  }
  return polynomial;
}

double HeightKriging::left_out(const Solution& solution) const {
  // The inverse system without the ones that stand on the polynomials.
  const Eigen::VectorXd own = solution.cholesky.inverse_diagonal() - basis_.rowwise().squaredNorm();
  double sum = 0.0;
  for (Eigen::Index i = 0; i < own.size(); ++i) {
    if (own[i] > 0.0) sum += solution.on_null_space[i] * solution.on_null_space[i] / own[i];
  }
  return sum / static_cast<double>(own.size());
}

Eigen::VectorXd HeightKriging::influence(const Solution& solution, const Eigen::Matrix2Xd& places,
                                         const Eigen::VectorXd& shares) const {
  const Eigen::Index rank = basis_.cols();
  const Eigen::VectorXd terms = monomials(places, upper_.cols()).transpose() * shares;
  Eigen::VectorXd along(rank);
  for (Eigen::Index k = 0; k < rank; ++k) along[k] = terms[order_[static_cast<std::size_t>(k)]];
  upper_.topLeftCorner(rank, rank).triangularView<Eigen::Upper>().transpose().solveInPlace(along);
  Eigen::VectorXd right =
      (scales_ * kernels_at(places_, places, shares)).matrix() - on_basis_ * along;
  right -= basis_ * (basis_.transpose() * right).eval();
  const Eigen::VectorXd scaled = basis_ * along + solution.cholesky.solve(right);
  return scales_ * scaled.array();
}

/// The weighed kernel times `scaled` from both sides, by its parts on the polynomials and off them;
/// off them it is what was solved, less the ratio.
double HeightKriging::kernel_square(const Solution& solution, const Eigen::VectorXd& scaled) const {
  const Eigen::VectorXd along = basis_.transpose() * scaled;
  const Eigen::VectorXd off = scaled - basis_ * along;
  const Eigen::VectorXd rooted = solution.cholesky.rooted(off);
  const Eigen::VectorXd crossed = on_basis_ * along;
  return rooted.squaredNorm() - solution.ratio * off.squaredNorm() +
         crossed.dot(basis_ * along + 2.0 * off);
}

double HeightKriging::wandering(const Solution& solution, const Eigen::VectorXd& influence,
                                const Eigen::Matrix2Xd& places,
                                const Eigen::VectorXd& shares) const {
  const double between = kernels_at(places, places, shares).matrix().dot(shares);
  const double across = kernels_at(places_, places, shares).matrix().dot(influence);
  const Eigen::VectorXd scaled = influence.array() / scales_;
  return std::max(between - 2.0 * across + kernel_square(solution, scaled), 0.0);
}

}  // namespace instep
