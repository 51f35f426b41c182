#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/surface/height_kriging.h"

namespace instep {

/// How likely the heights are for any noise and any roughness: restricted maximum likelihood, with
/// the polynomial taken out. The kernel is brought to tridiagonal form once, O(n^3); then each pair
/// costs O(n). Variances and roughnesses are those of the samples' own unit.
class KrigingLikelihood {
 public:
  explicit KrigingLikelihood(const HeightKriging& kriging);

  /// Twice the negative log likelihood, up to what depends on neither. `variance` and
  /// `roughness` > 0, their ratio well above the rounding of the kernel.
  double misfit(double variance, double roughness) const;

  /// What is thought of the roughness beforehand: a normal distribution of its logarithm.
  struct Prior {
    double usual = 0.0;
    double spread = 0.0;
  };
  /// Of the roughnesses from `roughest` down to `smoothest`, each `step` (below 1) of the last, the
  /// likeliest at that noise; `roughest` if none is likely at all.
  double likeliest(double variance, double roughest, double smoothest, double step,
                   const std::optional<Prior>& prior) const;

  /// The roughness that fits best for a noise of `ratio` times it, and the misfit then.
  struct Profile {
    double roughness = 0.0;
    double misfit = 0.0;
  };
  Profile profile(double ratio) const;

  /// Of the kernel: it bends the heights of neighbours apart by its roughness times this.
  double mean_diagonal() const;

  Eigen::Index free() const { return free_; }

 private:
  struct Reading {
    double log_volume = 0.0;
    double excess = 0.0;
  };
  Reading at(double ratio) const;

  Eigen::Index free_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd beside_;
  Eigen::VectorXd heights_;
};

}  // namespace instep
