#include "core/surface/noise/neighbourhood.h"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <utility>

#include "core/surface/heights/height_kriging.h"
#include "core/surface/heights/kriging_limits.h"
#include "core/surface/heights/quintic_patch.h"

namespace instep {
namespace {

/// Variances less than this part of the square of their radius are those of exact points.
constexpr double kExactVariance = 1e-10;
/// Standard deviation of the logarithm of the roughness over a body: smooth and creased parts.
constexpr double kRoughnessSpread = 2.0;
/// Ratios of noise to shape that are tried, against the kernel's own size.
constexpr double kLeastRatio = 1e-12;
constexpr double kMostRatio = 1e3;
constexpr double kRatioStep = 2.0;
/// Roughnesses that are tried, against one that explains all heights.
constexpr double kRoughest = 4.0;
constexpr double kSmoothest = 1e-8;
constexpr double kRoughnessStep = 0.5;
/// Terms of a quadratic in two variables: curvature is shape, not roughness.
constexpr Eigen::Index kTerms = 6;

double likeliest_variance(const KrigingLikelihood& likelihood) {
  const double scale = likelihood.mean_diagonal();
  return likelihood.likeliest_variance(kLeastRatio * scale, kMostRatio * scale, kRatioStep);
}

/// Of heights in units of `radius`.
std::optional<KrigingLikelihood> likelihood_of(const Eigen::Matrix3Xd& points, double radius) {
  const HeightSamples samples{points.topRows<2>() / radius, points.row(2).transpose() / radius,
                              Eigen::VectorXd::Ones(points.cols())};
  if (points.cols() < 2 * kTerms || !(radius > 0.0)) return std::nullopt;
  const auto kriging = HeightKriging::of(samples, kTerms);
  if (!kriging) return std::nullopt;
  return KrigingLikelihood(*kriging);
}

}  // namespace

bool Neighbourhood::is_exact() const {
  return variance <= kExactVariance * radius * radius;
}

double Neighbourhood::misfit(double of_variance, double of_roughness) const {
  return likelihood.misfit(of_variance / (radius * radius), of_roughness * radius);
}

double Neighbourhood::likely_roughness(double at_variance, std::optional<double> usual) const {
  const double scale = kMostRatio * likelihood.mean_diagonal();
  const double level = std::max(likelihood.likeliest_roughness(scale) * kMostRatio, 1e-300);
  std::optional<KrigingLikelihood::Prior> prior;
  if (usual) prior = KrigingLikelihood::Prior{*usual * radius, kRoughnessSpread};
  return likelihood.likeliest(at_variance / (radius * radius), kRoughest * level,
                              kSmoothest * level, kRoughnessStep, prior) /
         radius;
}

std::optional<Neighbourhood> neighbourhood_of(const TangentView& view) {
  const double radius = view.radius();
  auto likelihood = likelihood_of(view.points, radius);
  if (!likelihood) return std::nullopt;
  const double variance = radius * radius * likeliest_variance(*likelihood);
  return Neighbourhood{radius, std::move(*likelihood), variance};
}

double most_variance_in(const TangentView& view) {
  const double radius = view.radius();
  const Eigen::Index count = view.points.cols();
  if (count < 2 * kTerms || !(radius > 0.0)) return std::numeric_limits<double>::infinity();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(kLeastDetermined);
  qr.compute(monomials(view.points.topRows<2>() / radius, kTerms));
  Eigen::VectorXd heights = view.points.row(2).transpose();
  heights.applyOnTheLeft(qr.householderQ().setLength(qr.rank()).adjoint());
  const Eigen::Index free = count - qr.rank();
  return heights.tail(free).squaredNorm() / static_cast<double>(free);
}

bool is_plain(const TangentView& view) {
  std::vector<OrientedPoint> points;
  for (const auto& place : view.points.colwise())
    points.push_back({place, Eigen::Vector3d::UnitZ()});
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  return QuinticPatch::fit(points, middle, Eigen::Vector3d::UnitZ(), view.radius()).has_value();
}

std::optional<double> roughness_of_plain(const TangentView& view) {
  const auto half = Eigen::seq(0, Eigen::last, Eigen::fix<2>);
  const auto likelihood = likelihood_of(view.points(Eigen::all, half), view.radius());
  if (!likelihood) return std::nullopt;
  const double ratio = kLeastRatio * likelihood->mean_diagonal();
  return likelihood->likeliest_roughness(ratio) / view.radius();
}

}  // namespace instep
