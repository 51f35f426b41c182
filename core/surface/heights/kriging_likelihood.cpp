#include "core/surface/heights/kriging_likelihood.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace instep {
namespace {

/// So many pivots are multiplied before a logarithm is taken: few enough not to leave the range of
/// numbers.
constexpr Eigen::Index kFactorsALog = 8;

/// The first of a sequence, each `step` times the last.
template <class Group>
Group ladder(double first, double step) {
  Group rungs;
  for (Eigen::Index i = 0; i < rungs.size(); ++i, first *= step) rungs[i] = first;
  return rungs;
}

}  // namespace

KrigingLikelihood::KrigingLikelihood(const HeightKriging& kriging) {
  const Eigen::Tridiagonalization<Eigen::MatrixXd> form(kriging.reduced());
  diagonal_ = form.diagonal();
  beside_ = form.subDiagonal();
  heights_ = kriging.free_heights();
  heights_.applyOnTheLeft(form.matrixQ().adjoint());
}

KrigingLikelihood::Readings KrigingLikelihood::at(const Group& ratios) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Readings readings;
  Group pivot = diagonal_[0] + ratios;
  Group rest = Group::Constant(heights_[0]);
  Group product = pivot;
  Group least = pivot;
  readings.excess = rest * rest / pivot;
  for (Eigen::Index i = 1; i < diagonal_.size(); ++i) {
    const Group factor = beside_[i - 1] / pivot;
    rest = heights_[i] - factor * rest;
    pivot = diagonal_[i] + ratios - factor * beside_[i - 1];
    least = least.min(pivot);
    if (i % kFactorsALog == 0) {
      readings.log_volume += product.log();
      product = pivot;
    } else {
      product *= pivot;
    }
    readings.excess += rest * rest / pivot;
  }
  readings.log_volume += product.log();
  readings.log_volume = (least > 0.0).select(readings.log_volume, kInfinity);
  readings.excess = (least > 0.0).select(readings.excess, 0.0);
  return readings;
}

double KrigingLikelihood::misfit(double variance, double roughness) const {
  const Readings readings = at(Group::Constant(variance / roughness));
  return readings.log_volume[0] + free() * std::log(roughness) + readings.excess[0] / roughness;
}

double KrigingLikelihood::likeliest(double variance, double roughest, double smoothest, double step,
                                    const std::optional<Prior>& prior) const {
  double least = std::numeric_limits<double>::infinity();
  double chosen = roughest;
  Group trials = ladder<Group>(roughest, step);
  const double stride = std::pow(step, kGroup);
  for (; trials[0] >= smoothest; trials *= stride) {
    const Readings readings = at(variance / trials);
    Group misfits = readings.log_volume + free() * trials.log() + readings.excess / trials;
    if (prior) misfits += ((trials / prior->usual).log() / prior->spread).square();
    for (int i = 0; i < kGroup && trials[i] >= smoothest; ++i) {
      if (!(misfits[i] < least)) continue;
      least = misfits[i];
      chosen = trials[i];
    }
  }
  return chosen;
}

double KrigingLikelihood::likeliest_roughness(double ratio) const {
  return at(Group::Constant(ratio)).excess[0] / free();
}

double KrigingLikelihood::likeliest_variance(double least, double most, double step) const {
  const double count = free();
  double best = std::numeric_limits<double>::infinity();
  double variance = 0.0;
  Group ratios = ladder<Group>(least, step);
  const double stride = std::pow(step, kGroup);
  for (; ratios[0] < most; ratios *= stride) {
    const Readings readings = at(ratios);
    const Group roughness = readings.excess / count;
    const Group misfits = readings.log_volume + count * roughness.max(1e-300).log();
    for (int i = 0; i < kGroup && ratios[i] < most; ++i) {
      if (!(misfits[i] < best)) continue;
      best = misfits[i];
      variance = roughness[i] * ratios[i];
    }
  }
  return variance;
}

double KrigingLikelihood::mean_diagonal() const {
  return diagonal_.mean();
}

}  // namespace instep
