#include "core/surface/patches/height_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/point_spacing.h"
#include "core/surface/heights/kriging_likelihood.h"
#include "core/surface/heights/kriging_limits.h"

namespace instep {
namespace {

/// Fewer points than this carry a plane only.
constexpr std::size_t kFewestForQuadratic = 9;
/// And fewer than this are left over beside creases, or tell too little of how the base is bent.
constexpr std::size_t kFewestForBend = 24;
/// Standard deviation of the logarithm of the roughness round its likely value.
constexpr double kRoughnessSpread = 4.0;
/// The roughnesses that are tried, against the likely one.
constexpr double kRoughest = 1e5;
constexpr double kSmoothest = 1e-3;
constexpr double kRoughnessStep = 1.0 / 1.5;
/// Less smoothing than is likeliest for the heights: what is asked for in the end is a length, over
/// which noise averages out but the flattening of bends adds up.
constexpr double kAllowance = 2.0;
/// Bodies bend more round their girths than along them, feet and lasts 1.45 to 1.9 times by the
/// second derivatives of their patches, which go by the square of this: where there is noise,
/// distances along count for so much less. Sparse noisy feet and lasts err 1 to 4 % less for it. So
/// would sparse exact ones, but where a gap parts two sheets the surface over it would bulge.
constexpr double kBentRound = 1.2;
/// Variance that the polynomial's coefficients have beforehand, for comparing models.
constexpr double kCoefficientVariance = 0.1;
/// A smoother kernel than the last, and by how much it has to be likelier than that one (of twice
/// the log likelihood): beside a crease it overshoots, where r^3 does not, and r^7 further than
/// r^5.
struct SmootherKernel {
  HeightKernel kernel;
  double least_gain;
};
constexpr SmootherKernel kSmootherKernels[] = {{HeightKernel::kQuintic, 6.0},
                                               {HeightKernel::kSeptic, 30.0}};
/// Of the terms that a smoother kernel asks for one point must not tell one alone: where that is a
/// stray beside the lines of a scanner, surfaces were 20 mm off.
constexpr double kMostLeverage = 0.95;
/// Where all points are so little off the polynomial (of the radius) no stray is worth the work of
/// asking for it.
constexpr double kHarmlesslyOff = 0.01;
/// The variances of told slopes that are tried, against the roughness: normals may be as exact as
/// the points, or made from these by whoever sent them, or smoothed over creases.
constexpr double kExactSlopes = 1e-6;
constexpr double kWildSlopes = 1e6;
constexpr double kSlopeStep = 10.0;
/// Variance of exact heights below which a surface counts as even.
constexpr double kEven = 1e-10;

/// Whether all points within the radius are.
bool are_exact(const std::vector<OrientedPoint>& points, double radius) {
  const double spacing = spacing_within(radius, points.size());
  return std::all_of(points.begin(), points.end(),
                     [&](const OrientedPoint& point) { return is_harmless(point, spacing); });
}

/// Rows: round the body, along it, where distances count for less the more it is bent round, and
/// outwards.
Eigen::Matrix3d axes_with(const Eigen::Vector3d& outward, double bent_round) {
  Eigen::Vector3d along(-outward.y(), outward.x(), 0.0);
  if (along.squaredNorm() < 1e-12) along = Eigen::Vector3d::UnitX();
  Eigen::Matrix3d axes;
  axes.row(2) = outward;
  axes.row(1) = outward.cross(along).normalized();
  axes.row(0) = axes.row(1).cross(axes.row(2));
  const double lift = axes(1, 2) * axes(1, 2);
  axes.row(1) *= std::sqrt(1.0 - lift + lift / (bent_round * bent_round));
  return axes;
}

/// Of exact points one that is bent round the body as the quadratic that fits best: over the plane
/// the flanks of a patch seem nearer to each other than they are, and rise without bending. Slopes
/// tell bends as well on the plane, and where a gap parts two sheets a bent surface bulges further
/// over it; noisy points gain nothing, and in lines may be bent by their noise.
HeightBase base_of(const std::vector<OrientedPoint>& points, const HeightBase& plane) {
  const HeightSamples samples = samples_over(points, plane);
  if (points.size() < kFewestForBend || samples.has_slopes()) return plane;
  const auto trend = determined_quadratic(samples);
  if (!trend) return plane;
  const double turn = std::pow(1.0 + (*trend)[1] * (*trend)[1], 1.5);
  return plane.bent(-2.0 * (*trend)[3] / turn);
}

/// What the polynomial adds to twice the negative log likelihood, with its coefficients integrated
/// over.
double misfit_of_polynomial(const HeightKriging& kriging) {
  return kriging.log_determined() +
         static_cast<double>(kriging.terms()) * std::log(kCoefficientVariance);
}

/// Twice the negative log likelihood of exact heights, but for the polynomial.
double misfit_of_exact(const HeightKriging& kriging, const HeightKriging::Solution& solution) {
  const auto free = static_cast<double>(kriging.free());
  const double even = std::max(solution.excess / free, kEven);
  return solution.log_volume + free * (std::log(even) + 1.0);
}

/// The roughness of the highest likelihood and of a prior round the usual one.
double likeliest_roughness(const KrigingLikelihood& likelihood, double variance, double usual) {
  return likelihood.likeliest(variance, kRoughest * usual, kSmoothest * usual, kRoughnessStep,
                              KrigingLikelihood::Prior{usual, kRoughnessSpread});
}

/// A surface and what is thought of it, in unit scale.
struct Fit {
  HeightKriging kriging;
  HeightKriging::Solution solution;
  double misfit = 0.0;
  double roughness = 0.0;
  double wander = 0.0;  ///< the roughness that the heights show themselves
};

std::optional<Fit> exact_fit(std::optional<HeightKriging> kriging, double usual) {
  if (!kriging) return std::nullopt;
  auto solution = kriging->solve(kLeastSmoothing);
  if (!solution) return std::nullopt;
  const double misfit = misfit_of_exact(*kriging, *solution) + misfit_of_polynomial(*kriging);
  const double wander = solution->excess / static_cast<double>(kriging->free());
  return Fit{std::move(*kriging), std::move(*solution), misfit, usual, wander};
}

/// With as exact slopes as are likeliest, where they are told.
std::optional<Fit> exact_fit(const HeightSamples& samples, Eigen::Index terms, HeightKernel kernel,
                             double usual) {
  if (!samples.has_slopes()) return exact_fit(HeightKriging::of(samples, terms, kernel), usual);
  std::optional<Fit> best;
  for (double ratio = kExactSlopes; ratio <= kWildSlopes; ratio *= kSlopeStep) {
    auto fit = exact_fit(HeightKriging::of(samples, terms, kernel, ratio), usual);
    if (best && !(fit && fit->misfit < best->misfit)) break;
    best = std::move(fit);
  }
  return best;
}

/// By r^3 unless smoother kernels are plainly likelier, one after the other.
std::optional<Fit> likeliest_exact_fit(const HeightSamples& samples, double usual) {
  auto fit = exact_fit(samples, Quadratic::RowsAtCompileTime, HeightKernel::kCubic, usual);
  for (const auto& [kernel, least_gain] : kSmootherKernels) {
    auto smoother = exact_fit(samples, fewest_terms(kernel), kernel, usual);
    if (!smoother || smoother->kriging.most_leverage() > kMostLeverage) break;
    if (fit && !(smoother->misfit + least_gain < fit->misfit)) break;
    fit = std::move(smoother);
  }
  return fit;
}

std::optional<Fit> noisy_fit(HeightKriging kriging, double usual) {
  const KrigingLikelihood likelihood(kriging);
  const double likeliest = likeliest_roughness(likelihood, kriging.level(), usual);
  const double misfit =
      likelihood.misfit(kriging.level(), likeliest) + misfit_of_polynomial(kriging);
  auto solution = kriging.solve(kriging.level() / (kAllowance * likeliest) + kLeastSmoothing);
  if (!solution) return std::nullopt;
  return Fit{std::move(kriging), std::move(*solution), misfit, likeliest, likeliest};
}

/// `alike`: all kernels say the same, as of points so many that they were averaged.
std::optional<Fit> fit_to(const HeightSamples& samples, std::size_t points, bool exact, bool alike,
                          double usual) {
  const bool few = points < kFewestForQuadratic && !samples.has_slopes();
  std::optional<Fit> fit;
  if (exact && !few && !alike) {
    fit = likeliest_exact_fit(samples, usual);
  } else if (auto kriging = HeightKriging::of(samples, few ? 3 : Quadratic::RowsAtCompileTime)) {
    fit = exact ? exact_fit(std::move(kriging), usual) : noisy_fit(std::move(*kriging), usual);
  }
  return fit && std::isfinite(fit->misfit) ? std::move(fit) : std::nullopt;
}

/// From what r^3 gives to what the kernel does.
template <class Group>
void raise_to(HeightKernel kernel, const Group& squared, Group& of_cubic) {
  if (kernel == HeightKernel::kQuintic) of_cubic *= -squared;
  if (kernel == HeightKernel::kSeptic) of_cubic *= squared.square();
}

}  // namespace

std::optional<HeightPatch> HeightPatch::fit(const std::vector<OrientedPoint>& points,
                                            const Eigen::Vector3d& centre,
                                            const Eigen::Vector3d& outward, double radius,
                                            double roughness, bool crowded) {
  if (points.size() < 4 || !(radius > 0.0)) return std::nullopt;
  const bool exact = are_exact(points, radius);
  const HeightBase plane(axes_with(outward, exact ? 1.0 : kBentRound), centre, radius);
  HeightPatch patch(exact ? base_of(points, plane) : plane);
  patch.exact_ = exact;
  HeightSamples samples = samples_over(points, patch.base_);
  Quadratic trend = Quadratic::Zero();
  if (points.size() > kMostHeightSamples) {
    trend = least_squares(samples);
    CellAverages averages = averaged_rest(samples, trend);
    samples = std::move(averages.samples);
    patch.cells_ = std::move(averages.cells);
    patch.shares_ = std::move(averages.shares);
  }
  if (!patch.exact_) samples.slopes.resize(2, 0);
  const bool alike = points.size() > kMostHeightSamples || (crowded && !samples.has_slopes());
  auto fit =
      fit_to(samples, points.size(), patch.exact_, alike, std::max(roughness * radius, 1e-12));
  if (!fit) return std::nullopt;
  patch.misfit_ = fit->misfit;
  patch.wander_ = fit->wander;
  patch.roughness_ = fit->roughness / radius;
  patch.polynomial_ = fit->kriging.polynomial(fit->solution);
  patch.polynomial_.head<Quadratic::RowsAtCompileTime>() += trend;
  patch.set_columns(samples.places, fit->kriging.weights(fit->solution));
  patch.kriging_ = std::move(fit->kriging);
  patch.kriging_->forget_kernel();
  patch.solution_ = std::move(fit->solution);
  return patch;
}

/// In whole groups: what fills up the last one has no weight.
void HeightPatch::set_columns(const Eigen::Matrix2Xd& places, const Eigen::VectorXd& weights) {
  const Eigen::Index count = places.cols();
  const Eigen::Index whole = (count + kGroup - 1) / kGroup * kGroup;
  const auto filled_up = [&](const auto& values) {
    Column column = Column::Zero(whole);
    column.head(count) = values;
    return column;
  };
  x_ = filled_up(places.row(0).transpose().array());
  y_ = filled_up(places.row(1).transpose().array());
  weights_ = filled_up(weights.head(count).array());
  if (weights.size() == count) return;
  along_weights_ = filled_up(weights.segment(count, count).array());
  across_weights_ = filled_up(weights.tail(count).array());
}

HeightPatch::Sums HeightPatch::sums(const std::vector<Eigen::Vector3d>& positions,
                                    const Eigen::MatrixXd& shares) const {
  Eigen::Matrix2Xd places(2, shares.rows());
  for (Eigen::Index i = 0; i < shares.rows(); ++i) {
    places.col(i) = base_.see(positions[static_cast<std::size_t>(i)]).place;
  }
  HeightKriging::Sums of_samples = kriging_->sums(solution_, places, shares);
  Sums sums{of_samples.influence.topRows(kriging_->samples()),
            base_.radius() * base_.radius() * wander_ * of_samples.wandering};
  if (cells_.empty()) return sums;
  Eigen::MatrixXd of_points(shares_.size(), shares.cols());
  for (Eigen::Index i = 0; i < shares_.size(); ++i) {
    of_points.row(i) = shares_[i] * sums.influence.row(cells_[static_cast<std::size_t>(i)]);
  }
  sums.influence = std::move(of_points);
  return sums;
}

HeightPatch::Odd HeightPatch::odd_one() const {
  const auto [sample, gain] = kriging_->odd_one(solution_, kHarmlesslyOff);
  if (cells_.empty()) return {{static_cast<std::size_t>(sample)}, gain};
  Odd odd{{}, gain};
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i] == sample) odd.points.push_back(i);
  }
  return odd;
}

bool HeightPatch::is_smooth() const {
  return kriging_->kernel() == HeightKernel::kSeptic;
}

double HeightPatch::fine_bending() const {
  if (!exact_ || !(wander_ > 0.0)) return 1.0;
  return kriging_->left_out(solution_) / wander_;
}

std::vector<double> HeightPatch::missed() const {
  const Eigen::ArrayXd of_samples = base_.radius() * kriging_->missed(solution_);
  std::vector<double> missed(of_samples.data(), of_samples.data() + of_samples.size());
  if (cells_.empty()) return missed;
  missed.clear();
  for (const Eigen::Index sample : cells_) missed.push_back(of_samples[sample]);
  return missed;
}

HeightPatch::Rise HeightPatch::rise_of(const Polynomial& c, double x, double y) {
  return {c[0] + x * (c[1] + x * (c[3] + x * c[6]) + y * (c[4] + x * c[7])) +
              y * (c[2] + y * (c[5] + x * c[8] + y * c[9])),
          c[1] + x * (2.0 * c[3] + 3.0 * x * c[6]) + y * (c[4] + 2.0 * x * c[7] + y * c[8]),
          c[2] + y * (2.0 * c[5] + 3.0 * y * c[9]) + x * (c[4] + 2.0 * y * c[8] + x * c[7])};
}

FieldValue HeightPatch::at(const Eigen::Vector3d& position) const {
  const auto spot = base_.see(position);
  const double x = spot.place.x();
  const double y = spot.place.y();
  const HeightKernel kernel = kriging_->kernel();
  Group kernels = Group::Zero();
  Group slopes_x = Group::Zero();
  Group slopes_y = Group::Zero();
  for (Eigen::Index i = 0; i < x_.size(); i += kGroup) {
    const Group along = x - x_.segment<kGroup>(i);
    const Group across = y - y_.segment<kGroup>(i);
    const Group squared = along.square() + across.square();
    Group weighted = weights_.segment<kGroup>(i) * squared.sqrt();
    raise_to(kernel, squared, weighted);
    kernels += weighted * squared;
    slopes_x += weighted * along;
    slopes_y += weighted * across;
  }
  const double power = power_of(kernel);
  Rise rise = rise_of(polynomial_, x, y);
  rise.height += kernels.sum();
  rise.along += power * slopes_x.sum();
  rise.across += power * slopes_y.sum();
  if (along_weights_.size() > 0) add_slopes(x, y, rise);
  return {base_.radius() * (spot.height - rise.height),
          base_.gradient({rise.along, rise.across}, spot)};
}

/// The kernels of the samples' slopes: the derivatives of those of their heights.
void HeightPatch::add_slopes(double x, double y, Rise& rise) const {
  const HeightKernel kernel = kriging_->kernel();
  const double power = power_of(kernel);
  for (Eigen::Index i = 0; i < x_.size(); i += kGroup) {
    const Group along = x - x_.segment<kGroup>(i);
    const Group across = y - y_.segment<kGroup>(i);
    const Group squared = (along.square() + across.square()).max(kLeastSquared);
    const auto weights_along = along_weights_.segment<kGroup>(i);
    const auto weights_across = across_weights_.segment<kGroup>(i);
    const Group weighted = weights_along * along + weights_across * across;
    Group bend = power / squared.sqrt();
    raise_to(kernel, squared, bend);
    const Group slope = bend * squared;
    bend *= (power - 2.0) * weighted;
    rise.height -= (slope * weighted).sum();
    rise.along -= (slope * weights_along + bend * along).sum();
    rise.across -= (slope * weights_across + bend * across).sum();
  }
}

}  // namespace instep
