#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/surface/heights/height_kriging.h"

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

  /// The roughness that fits best for a noise of `ratio` times it.
  double likeliest_roughness(double ratio) const;

  /// The noise that fits best, with the roughness that then does, of ratios of the two from `least`
  /// up to below `most`, each `step` (above 1) times the last; zero if none fits at all.
  double likeliest_variance(double least, double most, double step) const;

  /// Of the kernel: it bends the heights of neighbours apart by its roughness times this.
  double mean_diagonal() const;

 private:
  /// So many ratios are read at once, for each has to wait for its own divisions.
  static constexpr int kGroup = 8;
  using Group = Eigen::Array<double, kGroup, 1>;
  struct Readings {
    Group log_volume = Group::Zero();  ///< infinite where rounding makes the system indefinite
    Group excess = Group::Zero();
  };
  Readings at(const Group& ratios) const;

  double free() const { return static_cast<double>(heights_.size()); }

  Eigen::VectorXd diagonal_;
  Eigen::VectorXd beside_;
  Eigen::VectorXd heights_;
};

}  // namespace instep
