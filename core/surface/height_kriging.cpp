#include "core/surface/height_kriging.h"

#include <algorithm>
#include <cmath>

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

/// Diagonal of the inverse of what was decomposed, by the columns of the inverse of the factor:
/// each begins as far down as it stands to the right.
Eigen::VectorXd inverse_diagonal(const Eigen::LLT<Eigen::MatrixXd>& cholesky) {
  const Eigen::MatrixXd& factor = cholesky.matrixLLT();
  const Eigen::Index count = factor.cols();
  Eigen::VectorXd diagonal(count);
  Eigen::VectorXd column(count);
  for (Eigen::Index from = 0; from < count; ++from) {
    column.tail(count - from).setZero();
    column[from] = 1.0;
    for (Eigen::Index i = from; i < count; ++i) {
      column[i] /= factor(i, i);
      const Eigen::Index rest = count - i - 1;
      column.tail(rest) -= column[i] * factor.col(i).tail(rest);
    }
    diagonal[from] = column.tail(count - from).squaredNorm();
  }
  return diagonal;
}

/// A quadratic along one line has as many terms as a plane.
bool span_a_plane(const Eigen::Matrix2Xd& places) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(monomials(places, 3));
  qr.setThreshold(kLeastDetermined);
  return qr.rank() == 3;
}

}  // namespace

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
  kriging.qr_.compute(scales.asDiagonal() * monomials(samples.places, terms));
  kriging.qr_.setThreshold(kLeastDetermined);
  const Eigen::Index rank = kriging.qr_.rank();
  if (rank < 3 || rank >= samples.size()) return std::nullopt;
  kriging.basis_ = Eigen::MatrixXd::Identity(samples.size(), rank);
  kriging.basis_.applyOnTheLeft(kriging.qr_.householderQ().setLength(rank));

  const Eigen::MatrixXd& basis = kriging.basis_;
  kriging.reduced_ = kernel_between(samples.places, kriging.scales_);
  kriging.on_basis_ = kriging.reduced_.selfadjointView<Eigen::Lower>() * basis;
  const Eigen::MatrixXd square = basis.transpose() * kriging.on_basis_;
  const Eigen::MatrixXd off =
      kriging.on_basis_ - 0.5 * basis * (square + Eigen::MatrixXd::Identity(rank, rank));
  subtract_both_ways(off, basis, kriging.reduced_);
  kriging.heights_ = scales.asDiagonal() * samples.heights;
  kriging.free_heights_ = kriging.heights_ - basis * (basis.transpose() * kriging.heights_).eval();
  return kriging;
}

double HeightKriging::log_determined() const {
  return 2.0 * qr_.matrixQR().diagonal().head(basis_.cols()).array().abs().log().sum() -
         2.0 * scales_.log().sum();
}

std::optional<HeightKriging::Solution> HeightKriging::solve(double ratio) const {
  Eigen::MatrixXd system = reduced_;
  system.diagonal().array() += ratio;
  Solution solution;
  solution.ratio = ratio;
  solution.cholesky.compute(system);
  if (solution.cholesky.info() != Eigen::Success) return std::nullopt;
  solution.on_null_space = solution.cholesky.solve(free_heights_);
  if (!solution.on_null_space.allFinite()) return std::nullopt;
  solution.log_volume = 2.0 * solution.cholesky.matrixLLT().diagonal().array().log().sum() -
                        static_cast<double>(basis_.cols()) * std::log(1.0 + ratio);
  solution.excess = free_heights_.dot(solution.on_null_space);
  return solution;
}

Eigen::VectorXd HeightKriging::weights(const Solution& solution) const {
  return scales_ * solution.on_null_space.array();
}

Quadratic HeightKriging::polynomial(const Solution& solution) const {
  const Eigen::Index rank = basis_.cols();
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(qr_.cols());
  coefficients.head(rank) =
      qr_.matrixQR()
          .topLeftCorner(rank, rank)
          .triangularView<Eigen::Upper>()
          .solve(basis_.transpose() * heights_ - on_basis_.transpose() * solution.on_null_space);
  Quadratic polynomial = Quadratic::Zero();
  polynomial.head(qr_.cols()) = qr_.colsPermutation() * coefficients;
  return polynomial;
}

double HeightKriging::left_out(const Solution& solution) const {
  const Eigen::Index count = places_.cols();
  const Eigen::VectorXd own = inverse_diagonal(solution.cholesky);
  double sum = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    // The inverse system without the ones that stand on the polynomials.
    const double free = own[i] - basis_.row(i).squaredNorm();
    if (free > 0.0) sum += solution.on_null_space[i] * solution.on_null_space[i] / free;
  }
  return sum / static_cast<double>(count);
}

Eigen::VectorXd HeightKriging::influence(const Solution& solution, const Eigen::Matrix2Xd& places,
                                         const Eigen::VectorXd& shares) const {
  const Eigen::Index rank = basis_.cols();
  const Eigen::VectorXd terms = monomials(places, qr_.cols()).transpose() * shares;
  const Eigen::VectorXd sought = qr_.colsPermutation().transpose() * terms;
  const Eigen::VectorXd along = qr_.matrixQR()
                                    .topLeftCorner(rank, rank)
                                    .triangularView<Eigen::Upper>()
                                    .transpose()
                                    .solve(sought.head(rank));
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
  const Eigen::VectorXd rooted = solution.cholesky.matrixU() * off;
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
