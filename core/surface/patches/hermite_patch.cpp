#include "core/surface/patches/hermite_patch.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>

#include "core/surface/heights/kriging_limits.h"

namespace instep {
namespace {

constexpr Eigen::Index kTerms = HermitePatch::Polynomial::RowsAtCompileTime;

/// Standard deviation granted to the unit slope along a normal: the field of a curved or creased
/// surface cannot have it everywhere.
constexpr double kSlopeDeviation = 0.05;
/// Most smoothing of the slopes, against a unit kernel or the smoothing of the values: exact
/// values whose slopes were free would be met by a field that vanishes.
constexpr double kMostSlopeSmoothing = 0.1;
constexpr double kSlopeToValueSmoothing = 10.0;

/// The kernel r^3 between all data: values first, then slopes along the normals. Only the lower
/// triangle is set.
Eigen::MatrixXd kernel_matrix(const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& normals) {
  const Eigen::Index count = positions.cols();
  Eigen::MatrixXd kernel(2 * count, 2 * count);
  for (Eigen::Index j = 0; j < count; ++j) {
    for (Eigen::Index i = j; i < count; ++i) {
      const Eigen::Vector3d offset = positions.col(i) - positions.col(j);
      const double r = offset.norm();
      const double along_i = offset.dot(normals.col(i));
      const double along_j = offset.dot(normals.col(j));
      const double both = r > 0.0 ? along_i * along_j / r : 0.0;
      kernel(i, j) = r * r * r;
      kernel(count + i, j) = 3.0 * r * along_i;
      kernel(count + j, i) = -3.0 * r * along_j;
      kernel(count + i, count + j) = -3.0 * (both + r * normals.col(i).dot(normals.col(j)));
    }
  }
  return kernel;
}

/// Monomials up to the second degree.
HermitePatch::Polynomial monomials(const Eigen::Vector3d& p) {
  HermitePatch::Polynomial terms;
  terms << 1.0, p, p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), p.x() * p.y(), p.y() * p.z(),
      p.z() * p.x();
  return terms;
}

/// Their gradients, one a column.
Eigen::Matrix<double, 3, kTerms> monomial_gradients(const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 3, kTerms> gradients;
  gradients.row(0) << 0, 1, 0, 0, 2 * p.x(), 0, 0, p.y(), 0, p.z();
  gradients.row(1) << 0, 0, 1, 0, 0, 2 * p.y(), 0, p.x(), p.z(), 0;
  gradients.row(2) << 0, 0, 0, 1, 0, 0, 2 * p.z(), 0, p.y(), p.x();
  return gradients;
}

Eigen::MatrixXd polynomial_block(const Eigen::Matrix3Xd& positions,
                                 const Eigen::Matrix3Xd& normals) {
  const Eigen::Index count = positions.cols();
  Eigen::MatrixXd block(2 * count, kTerms);
  for (Eigen::Index i = 0; i < count; ++i) {
    block.row(i) = monomials(positions.col(i)).transpose();
    block.row(count + i) = normals.col(i).transpose() * monomial_gradients(positions.col(i));
  }
  return block;
}

/// Q^T system Q for the Q of `qr`, of which only the lower triangle is read and written. All
/// `terms` reflections at once, as the product I - V T V^T (Schreiber and Van Loan 1989): one after
/// the other they would pass through the system each on its own.
void turn_into_basis(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index terms,
                     Eigen::MatrixXd& system) {
  Eigen::MatrixXd v = qr.matrixQR().leftCols(terms).triangularView<Eigen::UnitLower>();
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(terms, terms);
  for (Eigen::Index i = 0; i < terms; ++i) {
    t(i, i) = qr.hCoeffs()[i];
    t.col(i).head(i) =
        -t(i, i) * (t.topLeftCorner(i, i) * (v.leftCols(i).transpose() * v.col(i))).eval();
  }
  const Eigen::MatrixXd turned = system.selfadjointView<Eigen::Lower>() * (v * t);
  const Eigen::MatrixXd both = t.transpose() * (v.transpose() * turned);
  Eigen::MatrixXd left(v.rows(), 2 * terms);
  Eigen::MatrixXd right(v.rows(), 2 * terms);
  right << turned - 0.5 * v * both, v;
  left << v, right.leftCols(terms);
  system.triangularView<Eigen::Lower>() -= left * right.transpose();
}

}  // namespace

std::optional<HermitePatch> HermitePatch::fit(const std::vector<OrientedPoint>& points,
                                              const Eigen::Vector3d& centre, double radius,
                                              double roughness) {
  const auto count = static_cast<Eigen::Index>(points.size());
  if (count < 4 || !(radius > 0.0)) return std::nullopt;
  HermitePatch patch;
  patch.centre_ = centre;
  patch.radius_ = radius;
  patch.positions_.resize(3, count);
  patch.normals_.resize(3, count);
  Eigen::VectorXd smoothing(2 * count);
  const double unit = std::max(roughness * radius, 1e-12);
  for (Eigen::Index i = 0; i < count; ++i) {
    const OrientedPoint& point = points[static_cast<std::size_t>(i)];
    patch.positions_.col(i) = (point.position - centre) / radius;
    patch.normals_.col(i) = point.normal;
    smoothing[i] = std::max(point.variance / (radius * radius * unit), kLeastSmoothing);
    const double most = std::max(kMostSlopeSmoothing, kSlopeToValueSmoothing * smoothing[i]);
    smoothing[count + i] = std::min(kSlopeDeviation * kSlopeDeviation / unit, most);
  }

  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(
      polynomial_block(patch.positions_, patch.normals_));
  qr.setThreshold(kLeastDetermined);
  const Eigen::Index terms = qr.rank();
  if (terms < 4 || 2 * count < terms + 4) return std::nullopt;
  Eigen::MatrixXd system = kernel_matrix(patch.positions_, patch.normals_);
  system.diagonal() += smoothing;
  turn_into_basis(qr, terms, system);
  Eigen::VectorXd data(2 * count);
  data << Eigen::VectorXd::Zero(count), Eigen::VectorXd::Ones(count);
  const auto basis = qr.householderQ().setLength(terms);
  data.applyOnTheLeft(basis.adjoint());

  const Eigen::Index free = 2 * count - terms;
  const Eigen::MatrixXd coupling = system.bottomLeftCorner(free, terms);
  Eigen::Ref<Eigen::MatrixXd> definite = system.bottomRightCorner(free, free);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(definite);
  if (cholesky.info() != Eigen::Success) return std::nullopt;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(2 * count);
  weights.tail(free) = cholesky.solve(data.tail(free));
  Polynomial coefficients = Polynomial::Zero();
  coefficients.head(terms) =
      qr.matrixQR()
          .topLeftCorner(terms, terms)
          .triangularView<Eigen::Upper>()
          .solve(data.head(terms) - coupling.transpose() * weights.tail(free));
  patch.polynomial_ = qr.colsPermutation() * coefficients;
  weights.applyOnTheLeft(basis);
  if (!weights.allFinite() || !patch.polynomial_.allFinite()) return std::nullopt;
  patch.value_weights_ = weights.head(count);
  patch.slope_weights_ = weights.tail(count);
  return patch;
}

FieldValue HermitePatch::at(const Eigen::Vector3d& position) const {
  const Eigen::Vector3d place = (position - centre_) / radius_;
  double value = polynomial_.dot(monomials(place));
  Eigen::Vector3d gradient = monomial_gradients(place) * polynomial_;
  for (Eigen::Index j = 0; j < positions_.cols(); ++j) {
    const Eigen::Vector3d offset = place - positions_.col(j);
    const double r = offset.norm();
    const double along = offset.dot(normals_.col(j));
    value += r * (r * r * value_weights_[j] - 3.0 * along * slope_weights_[j]);
    const double inverse = r > 0.0 ? 1.0 / r : 0.0;
    gradient += 3.0 * (r * value_weights_[j] - along * inverse * slope_weights_[j]) * offset -
                3.0 * r * slope_weights_[j] * normals_.col(j);
  }
  return {radius_ * value, gradient};
}

}  // namespace instep
