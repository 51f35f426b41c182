#include "core/surface/height_patch.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace instep {
namespace {

/// Terms of the polynomial that the points determine less than this are left out.
constexpr double kLeastDetermined = 1e-3;
/// Fewer points than this carry a plane only.
constexpr std::size_t kFewestForQuadratic = 9;
constexpr std::size_t kMostSamples = 60;
/// Least smoothing, against a unit kernel: keeps the system solvable where points nearly coincide.
constexpr double kLeastSmoothing = 1e-10;
/// Points whose variance is less, in unit scale, are exact: nothing is smoothed.
constexpr double kExactVariance = 1e-10;
/// Standard deviation of the logarithm of the roughness round its likely value.
constexpr double kRoughnessSpread = 2.0;
/// The roughnesses that are tried, against the likely one: first by the wide factor, then by the
/// narrow one.
constexpr double kRoughest = 1e5;
constexpr double kSmoothest = 1e-3;
constexpr double kWideFactor = 25.0;
constexpr double kNarrowFactor = 5.0;
/// Less smoothing than is likeliest for the heights: what is asked for in the end is a length, over
/// which noise averages out but the flattening of bends adds up.
constexpr double kAllowance = 4.0;
/// Variance that the polynomial's coefficients have beforehand, for comparing models.
constexpr double kCoefficientVariance = 0.1;
/// Variance of exact heights below which a surface counts as even.
constexpr double kEven = 1e-10;

Eigen::Matrix3d axes_with(const Eigen::Vector3d& outward) {
  Eigen::Vector3d along(-outward.y(), outward.x(), 0.0);
  if (along.squaredNorm() < 1e-12) along = Eigen::Vector3d::UnitX();
  Eigen::Matrix3d axes;
  axes.row(2) = outward;
  axes.row(1) = outward.cross(along).normalized();
  axes.row(0) = axes.row(1).cross(axes.row(2));
  return axes;
}

/// The equations in the basis of the polynomial block's QR: on its null space, which is the tail,
/// they are positive definite.
class ReducedSystem {
 public:
  ReducedSystem(const HeightSamples& samples, Eigen::Index wanted_terms)
      : qr_(monomials(samples.places, wanted_terms)) {
    qr_.setThreshold(kLeastDetermined);
    terms_ = spans_a_plane(samples.places) ? qr_.rank() : 0;
    free_ = samples.size() - terms_;
    if (!is_determined()) return;
    const auto basis = qr_.householderQ().setLength(terms_);
    kernel_ = kernel_between(samples.places);
    kernel_.applyOnTheLeft(basis.adjoint());
    kernel_.applyOnTheRight(basis);
    noise_ = samples.variances.asDiagonal();
    noise_.applyOnTheLeft(basis.adjoint());
    noise_.applyOnTheRight(basis);
    data_ = samples.heights;
    data_.applyOnTheLeft(basis.adjoint());
    exact_ = !(samples.variances.maxCoeff() > kExactVariance);
  }

  bool is_determined() const { return terms_ >= 3 && free_ >= 1; }

  /// The roughness of the highest likelihood.
  double likeliest(double usual) const {
    if (exact_) return usual;
    double best = std::numeric_limits<double>::infinity();
    double chosen = usual;
    const auto attempt = [&](double roughness) {
      const double misfit =
          this->misfit(roughness) + std::pow(std::log(roughness / usual) / kRoughnessSpread, 2);
      if (!(misfit < best)) return;
      best = misfit;
      chosen = roughness;
    };
    for (double trial = kRoughest; trial >= kSmoothest; trial /= kWideFactor) {
      attempt(trial * usual);
    }
    const double middle = chosen;
    attempt(middle * kNarrowFactor);
    attempt(middle / kNarrowFactor);
    return chosen;
  }

  /// Twice the negative log likelihood, with the coefficients integrated over.
  double misfit(double roughness) const {
    const double volume = 2.0 * qr_.matrixQR().diagonal().head(terms_).array().abs().log().sum() +
                          static_cast<double>(terms_) * std::log(kCoefficientVariance);
    Eigen::MatrixXd covariance = kernel_.bottomRightCorner(free_, free_);
    if (exact_) {
      covariance.diagonal().array() += kLeastSmoothing;
    } else {
      covariance = roughness * covariance + noise_.bottomRightCorner(free_, free_);
    }
    const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance);
    if (cholesky.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    const double spread = 2.0 * cholesky.matrixLLT().diagonal().array().log().sum();
    const double excess = cholesky.matrixL().solve(data_.tail(free_)).squaredNorm();
    if (!exact_) return volume + spread + excess;
    const auto count = static_cast<double>(free_);
    return volume + spread + count * (std::log(std::max(excess / count, kEven)) + 1.0);
  }

  /// Weights of the kernels and coefficients of the polynomial; false if there are none.
  bool solve(double roughness, Eigen::VectorXd& weights, Quadratic& polynomial) const {
    Eigen::MatrixXd system = kernel_ + noise_ / roughness;
    system.diagonal().array() += kLeastSmoothing;
    const Eigen::LLT<Eigen::MatrixXd> cholesky(system.bottomRightCorner(free_, free_));
    if (cholesky.info() != Eigen::Success) return false;
    weights = Eigen::VectorXd::Zero(data_.size());
    weights.tail(free_) = cholesky.solve(data_.tail(free_));
    Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(qr_.cols());
    coefficients.head(terms_) =
        qr_.matrixQR()
            .topLeftCorner(terms_, terms_)
            .triangularView<Eigen::Upper>()
            .solve(data_.head(terms_) - system.topRightCorner(terms_, free_) * weights.tail(free_));
    polynomial.setZero();
    polynomial.head(qr_.cols()) = qr_.colsPermutation() * coefficients;
    weights.applyOnTheLeft(qr_.householderQ().setLength(terms_));
    return weights.allFinite() && polynomial.allFinite();
  }

 private:
  /// A quadratic along one line has as many terms as a plane.
  static bool spans_a_plane(const Eigen::Matrix2Xd& places) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(monomials(places, 3));
    qr.setThreshold(kLeastDetermined);
    return qr.rank() == 3;
  }

  static Eigen::MatrixXd kernel_between(const Eigen::Matrix2Xd& places) {
    const Eigen::Index count = places.cols();
    Eigen::MatrixXd kernel(count, count);
    for (Eigen::Index j = 0; j < count; ++j) {
      const Eigen::ArrayXd squared = (places.colwise() - places.col(j)).colwise().squaredNorm();
      kernel.col(j) = squared * squared.sqrt();
    }
    return kernel;
  }

  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
  Eigen::Index terms_ = 0;
  Eigen::Index free_ = 0;
  Eigen::MatrixXd kernel_;
  Eigen::MatrixXd noise_;
  Eigen::VectorXd data_;
  bool exact_ = true;
};

}  // namespace

std::optional<HeightPatch> HeightPatch::fit(const std::vector<OrientedPoint>& points,
                                            const Eigen::Vector3d& centre,
                                            const Eigen::Vector3d& outward, double radius,
                                            double roughness) {
  if (points.size() < 4 || !(radius > 0.0)) return std::nullopt;
  HeightPatch patch;
  patch.centre_ = centre;
  patch.radius_ = radius;
  patch.axes_ = axes_with(outward);
  HeightSamples samples = samples_over(points, patch.axes_, centre, radius);
  Quadratic trend = Quadratic::Zero();
  if (points.size() > kMostSamples) {
    trend = least_squares(samples);
    samples = averaged_rest(samples, trend);
  }
  const ReducedSystem system(samples, points.size() < kFewestForQuadratic ? 3 : 6);
  if (!system.is_determined()) return std::nullopt;
  const double likeliest = system.likeliest(std::max(roughness * radius, 1e-12));
  patch.roughness_ = likeliest / radius;
  patch.misfit_ = system.misfit(likeliest);
  if (!system.solve(kAllowance * likeliest, patch.weights_, patch.polynomial_)) return std::nullopt;
  patch.polynomial_ += trend;
  patch.places_ = std::move(samples.places);
  return patch;
}

FieldValue HeightPatch::at(const Eigen::Vector3d& position) const {
  const Eigen::Vector3d local = axes_ * (position - centre_) / radius_;
  const double x = local.x();
  const double y = local.y();
  const Quadratic& c = polynomial_;
  double height = c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y;
  Eigen::Vector2d slope(c[1] + 2.0 * c[3] * x + c[4] * y, c[2] + c[4] * x + 2.0 * c[5] * y);
  for (Eigen::Index j = 0; j < places_.cols(); ++j) {
    const Eigen::Vector2d offset = local.head<2>() - places_.col(j);
    const double squared = offset.squaredNorm();
    const double weighted = weights_[j] * std::sqrt(squared);
    height += weighted * squared;
    slope += 3.0 * weighted * offset;
  }
  const Eigen::Vector3d gradient(-slope.x(), -slope.y(), 1.0);
  return {radius_ * (local.z() - height), axes_.transpose() * gradient};
}

}  // namespace instep
