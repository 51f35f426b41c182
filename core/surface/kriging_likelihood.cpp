#include "core/surface/kriging_likelihood.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace instep {
namespace {

/// So many pivots are multiplied before a logarithm is taken: few enough not to leave the range of
/// numbers.
constexpr Eigen::Index kFactorsALog = 8;

}  // namespace

KrigingLikelihood::KrigingLikelihood(const HeightKriging& kriging) : free_(kriging.free()) {
  const Eigen::Tridiagonalization<Eigen::MatrixXd> form(kriging.reduced());
  diagonal_ = form.diagonal();
  beside_ = form.subDiagonal();
  heights_ = kriging.free_heights();
  heights_.applyOnTheLeft(form.matrixQ().adjoint());
}

KrigingLikelihood::Reading KrigingLikelihood::at(double ratio) const {
  Reading reading;
  double pivot = 0.0;
  double rest = 0.0;
  double product = 1.0;
  for (Eigen::Index i = 0; i < diagonal_.size(); ++i) {
    const double factor = i > 0 ? beside_[i - 1] / pivot : 0.0;
    rest = heights_[i] - factor * rest;
    pivot = diagonal_[i] + ratio - (i > 0 ? factor * beside_[i - 1] : 0.0);
    if (!(pivot > 0.0)) return {std::numeric_limits<double>::infinity(), 0.0};
    product *= pivot;
    if (i % kFactorsALog == kFactorsALog - 1) {
      reading.log_volume += std::log(product);
      product = 1.0;
    }
    reading.excess += rest * rest / pivot;
  }
  reading.log_volume += std::log(product);
  // On the polynomials stands a one.
  reading.log_volume -= static_cast<double>(diagonal_.size() - free_) * std::log(1.0 + ratio);
  return reading;
}

double KrigingLikelihood::misfit(double variance, double roughness) const {
  const Reading reading = at(variance / roughness);
  return reading.log_volume + static_cast<double>(free_) * std::log(roughness) +
         reading.excess / roughness;
}

double KrigingLikelihood::likeliest(double variance, double roughest, double smoothest, double step,
                                    const std::optional<Prior>& prior) const {
  double least = std::numeric_limits<double>::infinity();
  double chosen = roughest;
  for (double trial = roughest; trial >= smoothest; trial *= step) {
    double misfit = this->misfit(variance, trial);
    if (prior) misfit += std::pow(std::log(trial / prior->usual) / prior->spread, 2);
    if (!(misfit < least)) continue;
    least = misfit;
    chosen = trial;
  }
  return chosen;
}

KrigingLikelihood::Profile KrigingLikelihood::profile(double ratio) const {
  const Reading reading = at(ratio);
  const auto count = static_cast<double>(free_);
  const double roughness = reading.excess / count;
  return {roughness, reading.log_volume + count * std::log(std::max(roughness, 1e-300))};
}

double KrigingLikelihood::mean_diagonal() const {
  const auto terms = static_cast<double>(diagonal_.size() - free_);
  return (diagonal_.sum() - terms) / static_cast<double>(free_);
}

}  // namespace instep
