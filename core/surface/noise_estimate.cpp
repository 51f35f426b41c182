#include "core/surface/noise_estimate.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/median.h"

namespace instep {
namespace {

constexpr std::size_t kNeighbourhoods = 40;
/// Standard deviation of the logarithm of the roughness over a body: smooth and creased parts.
constexpr double kRoughnessSpread = 2.0;
/// The shape between the neighbourhoods may be rougher than they are: measured on scanned feet,
/// where the plain estimate flattens bends.
constexpr double kAllowance = 1.0;
constexpr double kLeastRoughness = 1e-12;
constexpr std::size_t kPoints = 60;
/// Terms of a quadratic in two variables: curvature is shape, not roughness.
constexpr Eigen::Index kTerms = 6;
/// A neighbourhood whose thickness is at most this part of its width is flat enough. One that is
/// not is taken larger, where noise is thicker than the spacing, or smaller, where it bends too
/// much or reaches across a thin part; the flattest counts.
constexpr double kFlatEnough = 0.15;
constexpr std::array<std::size_t, 6> kTriedPoints = {60, 30, 20, 120, 240, 480};

/// A neighbourhood in the basis where kernel and noise are both diagonal.
struct Spectrum {
  Eigen::VectorXd kernel;  ///< eigenvalues of the kernel on the null space of the quadratics
  Eigen::VectorXd squared_heights;
};

/// Heights over the tangent plane: columns are points, the third row is the height.
struct TangentView {
  Eigen::Matrix3Xd points;
  double thickness = std::numeric_limits<double>::infinity();  ///< against the width
};

TangentView tangent_view(const std::vector<Eigen::Vector3d>& points,
                         const std::vector<PointIndex::Neighbour>& nearest) {
  TangentView view;
  const std::size_t stride = (nearest.size() + kPoints - 1) / kPoints;
  view.points.resize(3, static_cast<Eigen::Index>((nearest.size() + stride - 1) / stride));
  for (std::size_t i = 0; i * stride < nearest.size(); ++i) {
    view.points.col(static_cast<Eigen::Index>(i)) = points[nearest[i * stride].index];
  }
  view.points.colwise() -= view.points.rowwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(view.points * view.points.transpose());
  view.points = axes.eigenvectors().rowwise().reverse().transpose() * view.points;
  const Eigen::Vector3d spread = axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (spread[1] > 0.0) view.thickness = spread[0] / spread[1];
  return view;
}

TangentView flattest_view(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
                          const Eigen::Vector3d& centre) {
  TangentView best;
  for (const std::size_t count : kTriedPoints) {
    TangentView view = tangent_view(points, index.nearest(centre, count));
    if (view.thickness < best.thickness) best = std::move(view);
    if (best.thickness <= kFlatEnough) break;
  }
  return best;
}

std::optional<Spectrum> spectrum_of(const Eigen::Matrix3Xd& local) {
  const Eigen::Index count = local.cols();
  if (count < 2 * kTerms) return std::nullopt;
  const Eigen::ArrayXd x = local.row(0).transpose() / local.row(0).norm();
  const Eigen::ArrayXd y = local.row(1).transpose() / local.row(0).norm();
  Eigen::MatrixXd quadratic(count, kTerms);
  quadratic << Eigen::ArrayXd::Ones(count), x, y, x * x, x * y, y * y;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(quadratic);
  Eigen::MatrixXd kernel(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double r = (local.col(i) - local.col(j)).head<2>().norm();
      kernel(i, j) = r * r * r;
    }
  }
  kernel.applyOnTheLeft(qr.householderQ().adjoint());
  kernel.applyOnTheRight(qr.householderQ());
  Eigen::VectorXd heights = local.row(2).transpose();
  heights.applyOnTheLeft(qr.householderQ().adjoint());
  const Eigen::Index free = count - kTerms;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(kernel.bottomRightCorner(free, free));
  return Spectrum{solver.eigenvalues().cwiseMax(0.0),
                  (solver.eigenvectors().transpose() * heights.tail(free)).cwiseAbs2()};
}

/// Twice the negative log likelihood of the heights.
double misfit(const Spectrum& spectrum, double roughness, double variance) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < spectrum.kernel.size(); ++i) {
    const double total = roughness * spectrum.kernel[i] + variance;
    sum += std::log(total) + spectrum.squared_heights[i] / total;
  }
  return sum;
}

/// The noise variance that fits best if the roughness may be anything.
double own_variance(const Spectrum& spectrum) {
  const double largest = std::max(spectrum.kernel.maxCoeff(), std::numeric_limits<double>::min());
  const auto count = static_cast<double>(spectrum.kernel.size());
  double best = std::numeric_limits<double>::infinity();
  double variance = 0.0;
  for (double ratio = 1e-12; ratio < 2e3; ratio *= 2.0) {
    const Eigen::ArrayXd total = spectrum.kernel.array() + ratio * largest;
    const double scale = (spectrum.squared_heights.array() / total).sum() / count;
    if (!(scale > 0.0)) return 0.0;
    const double fit = total.log().sum() + count * std::log(scale);
    if (fit < best) {
      best = fit;
      variance = scale * ratio * largest;
    }
  }
  return variance;
}

/// The roughness that fits best at a given noise; the likelihood is flat where noise hides the
/// shape, so it is held near `usual`, if that is known.
double likely_roughness(const Spectrum& spectrum, double variance, std::optional<double> usual) {
  const double level = spectrum.squared_heights.sum() / std::max(spectrum.kernel.sum(), 1e-300);
  double best = std::numeric_limits<double>::infinity();
  double roughness = level;
  for (double trial = 4.0 * level; trial > 1e-8 * level; trial *= 0.7) {
    double fit = misfit(spectrum, trial, variance);
    if (usual) fit += std::pow(std::log(trial / *usual) / kRoughnessSpread, 2);
    if (fit < best) {
      best = fit;
      roughness = trial;
    }
  }
  return roughness;
}

}  // namespace

NoiseEstimate estimate_noise(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
                             const std::vector<std::size_t>& places, std::optional<double> sigma) {
  std::vector<Spectrum> spectra;
  std::vector<double> variances;
  NoiseEstimate estimate;
  const std::size_t stride = std::max<std::size_t>(1, places.size() / kNeighbourhoods);
  for (std::size_t i = stride / 2; i < places.size(); i += stride) {
    const Eigen::Vector3d& place = points[places[i]];
    auto spectrum = spectrum_of(flattest_view(points, index, place).points);
    if (!spectrum) continue;
    if (!sigma) variances.push_back(own_variance(*spectrum));
    spectra.push_back(std::move(*spectrum));
    estimate.roughness.push_back({place, 0.0});
  }
  if (spectra.empty()) return {sigma.value_or(0.0), {}};
  estimate.sigma = sigma ? *sigma : std::sqrt(median(std::move(variances)));
  const double variance = std::max(estimate.sigma * estimate.sigma, 1e-24);
  std::vector<double> free;
  for (const auto& spectrum : spectra) {
    free.push_back(likely_roughness(spectrum, variance, std::nullopt));
  }
  const double usual = std::max(median(std::move(free)), 1e-300);
  for (std::size_t i = 0; i < spectra.size(); ++i) {
    estimate.roughness[i].roughness = likely_roughness(spectra[i], variance, usual);
  }
  return estimate;
}

double roughness_at(const std::vector<LocalRoughness>& known, const Eigen::Vector3d& place) {
  double weights = 0.0;
  double sum = 0.0;
  for (const auto& local : known) {
    const double weight = 1.0 / (std::pow((local.place - place).squaredNorm(), 2) + 1e-30);
    weights += weight;
    sum += weight * std::log(std::max(kAllowance * local.roughness, kLeastRoughness));
  }
  return weights > 0.0 ? std::exp(sum / weights) : kLeastRoughness;
}

}  // namespace instep
