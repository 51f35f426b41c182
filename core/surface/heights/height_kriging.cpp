#include "core/surface/heights/height_kriging.h"

#include <algorithm>
#include <cmath>

#include "core/surface/heights/kriging_limits.h"

namespace instep {
namespace {

/// No sample outweighs the least certain one by more, or a certain one would leave the others no
/// say in how rough the surface is.
constexpr double kLargestScale = 1e3;

/// A sample of which the others tell less than this, against the one that they tell most of, is
/// told by the polynomial alone: it has nothing left over but rounding.
constexpr double kLeastTold = 1e-9;
/// Of fewer free readings each takes most of the excess: of patches of five or nine points whose
/// noise is even one in 25 has one that gains over 16.
constexpr Eigen::Index kFewestFree = 6;
/// Of what is left over: short of all of it, whose logarithm knows no end.
constexpr double kMostShare = 1.0 - 1e-15;

/// Columns of an inverse that are solved for side by side: enough to keep wide vectors busy.
constexpr Eigen::Index kSideBySide = 16;
using SideBySide = Eigen::Array<double, kSideBySide, 1>;

/// Diagonal of the inverse of what was decomposed: the squares of the columns of the inverse of the
/// factor, which begin as far down as they stand to the right.
Eigen::VectorXd inverse_diagonal(const Eigen::LLT<Eigen::MatrixXd>& cholesky) {
  const Eigen::MatrixXd rows = cholesky.matrixLLT().transpose();
  const Eigen::Index count = rows.cols();
  Eigen::VectorXd diagonal(count);
  Eigen::Array<double, kSideBySide, Eigen::Dynamic> solved(kSideBySide, count);
  for (Eigen::Index from = 0; from < count; from += kSideBySide) {
    SideBySide squares = SideBySide::Zero();
    for (Eigen::Index i = from; i < count; ++i) {
      SideBySide rest = SideBySide::Zero();
      if (i < from + kSideBySide) rest[i - from] = 1.0;
      for (Eigen::Index k = from; k < i; ++k) rest -= rows(k, i) * solved.col(k);
      solved.col(i) = rest / rows(i, i);
      squares += solved.col(i).square();
    }
    const Eigen::Index columns = std::min(kSideBySide, count - from);
    diagonal.segment(from, columns) = squares.head(columns);
  }
  return diagonal;
}

Eigen::VectorXd readings_of(const HeightSamples& samples) {
  Eigen::VectorXd readings(samples.size() + samples.slopes.size());
  readings << samples.heights, samples.slopes.transpose().reshaped();
  return readings;
}

Eigen::MatrixXd polynomial_block(const HeightSamples& samples, Eigen::Index terms) {
  if (!samples.has_slopes()) return monomials(samples.places, terms);
  Eigen::MatrixXd block(3 * samples.size(), terms);
  block << monomials(samples.places, terms), monomial_slopes(samples.places, terms);
  return block;
}

/// The lower triangle, both sides scaled.
Eigen::MatrixXd kernel_of(const HeightSamples& samples, HeightKernel kernel,
                          const Eigen::ArrayXd& scales, double slope_ratio) {
  if (!samples.has_slopes()) return kernel_between(kernel, samples.places, scales);
  Eigen::MatrixXd matrix = sloped_kernel_between(kernel, samples.places, scales);
  matrix.diagonal().tail(samples.slopes.size()).array() += slope_ratio;
  return matrix;
}

/// Of the readings. Slopes have a variance of their own.
Eigen::ArrayXd scales_of(const HeightSamples& samples) {
  Eigen::ArrayXd scales = Eigen::ArrayXd::Ones(samples.size() + samples.slopes.size());
  const double most = samples.variances.maxCoeff();
  if (most > 0.0) {
    scales.head(samples.size()) = (most / samples.variances.array()).sqrt().min(kLargestScale);
  }
  return scales;
}

/// A quadratic along one line has as many terms as a plane.
bool span_a_plane(const Eigen::Matrix2Xd& places) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(monomials(places, 3));
  qr.setThreshold(kLeastDetermined);
  return qr.rank() == 3;
}

}  // namespace

std::optional<HeightKriging> HeightKriging::of(const HeightSamples& samples, Eigen::Index terms,
                                               HeightKernel kernel, double slope_ratio) {
  if (samples.size() < 4) return std::nullopt;
  HeightKriging kriging;
  kriging.kernel_ = kernel;
  kriging.places_ = samples.places;
  kriging.level_ = samples.variances.maxCoeff();
  kriging.scales_ = scales_of(samples);
  const Eigen::VectorXd scales = kriging.scales_;
  kriging.qr_.compute(scales.asDiagonal() * polynomial_block(samples, terms));
  kriging.qr_.setThreshold(kLeastDetermined);
  const Eigen::Index rank = kriging.qr_.rank();
  if (rank < fewest_terms(kernel) || rank >= scales.size()) return std::nullopt;
  if (rank < terms && !span_a_plane(samples.places)) return std::nullopt;
  kriging.set_reflectors(rank);
  kriging.set_kernel(kernel_of(samples, kernel, kriging.scales_, slope_ratio));
  kriging.heights_ = scales.asDiagonal() * readings_of(samples);
  kriging.free_heights_ = kriging.off_polynomials(kriging.heights_);
  return kriging;
}

Eigen::MatrixXd HeightKriging::kernels_round(const Eigen::Matrix2Xd& places) const {
  return has_slopes() ? sloped_kernels_at(kernel_, places_, places)
                      : kernels_at(kernel_, places_, places);
}

/// The reflections of the decomposition as one block, I - V T V' (Schreiber and Van Loan 1989): its
/// first columns span the polynomials, the others all that is off them.
void HeightKriging::set_reflectors(Eigen::Index rank) {
  const Eigen::Index count = scales_.size();
  reflectors_ = qr_.matrixQR().leftCols(rank).triangularView<Eigen::StrictlyLower>();
  reflectors_.diagonal().setOnes();
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(rank, rank);
  for (Eigen::Index j = 0; j < rank; ++j) {
    const double size = qr_.hCoeffs()[j];
    factor(j, j) = size;
    factor.col(j).head(j) = -size * (factor.topLeftCorner(j, j) *
                                     (reflectors_.leftCols(j).transpose() * reflectors_.col(j)));
  }
  scaled_reflectors_ = reflectors_ * factor;
  basis_ = Eigen::MatrixXd::Identity(count, rank) -
           scaled_reflectors_ * reflectors_.topRows(rank).transpose();
}

/// `kernel`: the lower triangle.
void HeightKriging::set_kernel(const Eigen::MatrixXd& kernel) {
  const Eigen::Index rank = basis_.cols();
  const Eigen::Index rest = free();
  const Eigen::MatrixXd reflected = kernel.selfadjointView<Eigen::Lower>() * scaled_reflectors_;
  on_basis_ = kernel.leftCols(rank);
  on_basis_.topRows(rank) =
      kernel.topLeftCorner(rank, rank).selfadjointView<Eigen::Lower>().toDenseMatrix();
  on_basis_ -= reflected * reflectors_.topRows(rank).transpose();
  const Eigen::MatrixXd off =
      reflected - 0.5 * reflectors_ * (scaled_reflectors_.transpose() * reflected);
  reduced_ = kernel.bottomRightCorner(rest, rest);
  Eigen::MatrixXd left(rest, 2 * rank);
  Eigen::MatrixXd right(rest, 2 * rank);
  left << off.bottomRows(rest), reflectors_.bottomRows(rest);
  right << reflectors_.bottomRows(rest), off.bottomRows(rest);
  reduced_.triangularView<Eigen::Lower>() -= left * right.transpose();
}

Eigen::MatrixXd HeightKriging::off_polynomials(const Eigen::MatrixXd& scaled) const {
  const Eigen::MatrixXd along = scaled_reflectors_.transpose().lazyProduct(scaled);
  return scaled.bottomRows(free()) - reflectors_.bottomRows(free()).lazyProduct(along);
}

Eigen::MatrixXd HeightKriging::from_off_polynomials(const Eigen::MatrixXd& reduced) const {
  const Eigen::MatrixXd along = reflectors_.bottomRows(free()).transpose().lazyProduct(reduced);
  Eigen::MatrixXd scaled = -scaled_reflectors_.lazyProduct(along);
  scaled.bottomRows(free()) += reduced;
  return scaled;
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
  const Eigen::VectorXd solved = solution.cholesky.solve(free_heights_);
  if (!solved.allFinite()) return std::nullopt;
  solution.on_null_space = from_off_polynomials(solved);
  solution.log_volume = 2.0 * solution.cholesky.matrixLLT().diagonal().array().log().sum();
  solution.excess = free_heights_.dot(solved);
  return solution;
}

Eigen::VectorXd HeightKriging::weights(const Solution& solution) const {
  return scales_ * solution.on_null_space.array();
}

Polynomial HeightKriging::polynomial(const Solution& solution) const {
  const Eigen::Index rank = basis_.cols();
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(qr_.cols());
  coefficients.head(rank) =
      qr_.matrixQR()
          .topLeftCorner(rank, rank)
          .triangularView<Eigen::Upper>()
          .solve(basis_.transpose() * heights_ - on_basis_.transpose() * solution.on_null_space);
  Polynomial polynomial = Polynomial::Zero();
  polynomial.head(qr_.cols()) = qr_.colsPermutation() * coefficients;
  return polynomial;
}

Eigen::ArrayXd HeightKriging::diagonal_of_inverse(const Solution& solution) const {
  const Eigen::Index rest = free();
  Eigen::MatrixXd solved = Eigen::MatrixXd::Zero(scales_.size(), basis_.cols());
  solved.bottomRows(rest) = solution.cholesky.solve(reflectors_.bottomRows(rest));
  const Eigen::MatrixXd square = reflectors_.transpose() * solved;
  Eigen::ArrayXd own =
      (scaled_reflectors_ * square - 2.0 * solved).cwiseProduct(scaled_reflectors_).rowwise().sum();
  own.tail(rest) += inverse_diagonal(solution.cholesky).array();
  return own;
}

double HeightKriging::left_out(const Solution& solution) const {
  const Eigen::ArrayXd own = diagonal_of_inverse(solution);
  const Eigen::ArrayXd squares = solution.on_null_space.array().square() / own;
  return (own > 0.0).select(squares, 0.0).sum() / static_cast<double>(scales_.size());
}

Eigen::ArrayXd HeightKriging::missed(const Solution& solution) const {
  const Eigen::ArrayXd own = diagonal_of_inverse(solution);
  const Eigen::ArrayXd weighed = (own > 0.0).select(solution.on_null_space.array() / own, 0.0);
  return (weighed / scales_).head(samples());
}

double HeightKriging::most_leverage() const {
  return basis_.topRows(samples()).rowwise().squaredNorm().maxCoeff();
}

HeightKriging::Odd HeightKriging::odd_one(const Solution& solution, double harmless) const {
  Odd odd{0, 0.0};
  const Eigen::ArrayXd off = from_off_polynomials(free_heights_).col(0).array() / scales_;
  if (free() < kFewestFree || !(off.head(samples()).abs().maxCoeff() > harmless)) return odd;
  const Eigen::ArrayXd own = diagonal_of_inverse(solution).head(samples());
  const Eigen::ArrayXd squares = solution.on_null_space.head(samples()).array().square() / own;
  const auto told = own > kLeastTold * own.maxCoeff();
  const double share = told.select(squares, 0.0).maxCoeff(&odd.sample) / solution.excess;
  odd.gain = -static_cast<double>(free()) * std::log1p(-std::min(share, kMostShare));
  return odd;
}

HeightKriging::Sums HeightKriging::sums(const Solution& solution, const Eigen::Matrix2Xd& places,
                                        const Eigen::MatrixXd& shares) const {
  const Eigen::Index rank = basis_.cols();
  const Eigen::MatrixXd terms = monomials(places, qr_.cols()).transpose().lazyProduct(shares);
  const Eigen::MatrixXd sought = qr_.colsPermutation().transpose() * terms;
  const Eigen::MatrixXd along = qr_.matrixQR()
                                    .topLeftCorner(rank, rank)
                                    .triangularView<Eigen::Upper>()
                                    .transpose()
                                    .solve(sought.topRows(rank));
  const Eigen::MatrixXd across = kernels_round(places).lazyProduct(shares);
  const Eigen::MatrixXd crossed = on_basis_.lazyProduct(along);
  const Eigen::MatrixXd off = off_polynomials(scales_.matrix().asDiagonal() * across - crossed);
  Eigen::MatrixXd solved(off.rows(), off.cols());
  for (Eigen::Index i = 0; i < off.cols(); ++i) {
    solved.col(i) = solution.cholesky.solve(off.col(i));  // quicker than all of so few at once
  }
  const Eigen::MatrixXd on_polynomials = basis_.lazyProduct(along);
  const Eigen::MatrixXd scaled = on_polynomials + from_off_polynomials(solved);
  Sums sums;
  sums.influence = scales_.matrix().asDiagonal() * scaled;
  const auto of_columns = [](const auto& a, const auto& b) -> Eigen::ArrayXd {
    return a.cwiseProduct(b).colwise().sum().transpose();
  };
  // The weighed kernel from both sides, by its parts on the polynomials and off them; off them it
  // is what was solved, less the ratio.
  const Eigen::ArrayXd own = of_columns(solved, off - solution.ratio * solved) +
                             of_columns(crossed, 2.0 * scaled - on_polynomials);
  const Eigen::ArrayXd between =
      of_columns(kernels_at(kernel_, places, places).lazyProduct(shares), shares);
  sums.wandering = (between - 2.0 * of_columns(across, sums.influence) + own).max(0.0);
  return sums;
}

}  // namespace instep
