#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>
#include <optional>

#include "core/surface/heights/height_kernel.h"
#include "core/surface/heights/height_samples.h"

namespace instep {

/// The paper's system (eqs. 6 and 7, phi = r^3, r^5 or r^7, a smoothing for each point) for heights
/// over a base, with a polynomial; read as kriging: once the polynomial is taken out, heights
/// wander with covariance roughness * phi and carry noise on top.
///
/// It is solved on the null space of the polynomial block, where it is positive definite and by as
/// many rows smaller as there are terms: reflections turn the kernel there, and Cholesky's method
/// does the rest. Unequal variances are made equal first, by weighing each sample, so that all
/// depends on one number, the ratio of noise to roughness.
///
/// Samples may have slopes too. They count as samples of their own: all vectors of readings hold
/// the heights first, then the slopes along x, then those along y.
class HeightKriging {
 public:
  /// Nothing if the samples do not determine the polynomial (fewer than four, all on one line; for
  /// r^5 and r^7 all of fewest_terms()). `terms`: 3, 6 or 10, fewest_terms() at least. The
  /// variances count only against each other. `slope_ratio`: of a slope's variance to the
  /// roughness, over that of solve(); wandering() counts it in. O(n^2) for n readings.
  static std::optional<HeightKriging> of(const HeightSamples& samples, Eigen::Index terms,
                                         HeightKernel kernel = HeightKernel::kCubic,
                                         double slope_ratio = 0.0);

  HeightKernel kernel() const { return kernel_; }

  /// Variance of a sample of weight one: the least certain one's.
  double level() const { return level_; }
  Eigen::Index samples() const { return places_.cols(); }
  /// Readings that the polynomial leaves over.
  Eigen::Index free() const { return scales_.size() - terms(); }
  /// Of the polynomial, as many as the samples determine.
  Eigen::Index terms() const { return basis_.cols(); }
  /// The kernel on the null space of the polynomials, free() rows in an orthonormal basis of it:
  /// the lower triangle of a symmetric matrix.
  const Eigen::MatrixXd& reduced() const { return reduced_; }
  /// The weighed heights there, in the same basis.
  const Eigen::VectorXd& free_heights() const { return free_heights_; }
  /// Log determinant of the polynomial block, for comparing models.
  double log_determined() const;

  /// All that follows from one ratio of level() to roughness.
  struct Solution {
    double ratio = 0.0;
    Eigen::LLT<Eigen::MatrixXd> cholesky;
    Eigen::VectorXd on_null_space;
    double log_volume = 0.0;  ///< log determinant of kernel + ratio
    /// Squares of the heights over kernel + ratio. Divided by free(), the likeliest roughness.
    double excess = 0.0;
  };
  /// Nothing if rounding makes the system indefinite. `ratio` > 0. O(n^3).
  std::optional<Solution> solve(double ratio) const;

  /// Frees what reduced() and solve() read; neither may be called afterwards.
  void forget_kernel() { reduced_.resize(0, 0); }

  /// Weights of the kernels round the samples.
  Eigen::VectorXd weights(const Solution& solution) const;
  Polynomial polynomial(const Solution& solution) const;

  /// How far each reading is off what the others predict, against what is expected of that for a
  /// roughness of one: mean square (leave-one-out). Like the roughness itself where that is the
  /// same at all scales; less where the surface is smoother than the kernel takes it to be. O(n^3).
  double left_out(const Solution& solution) const;

  /// How far each sample's height is off what the other readings predict, its own slopes among
  /// them. O(n^3).
  Eigen::ArrayXd missed(const Solution& solution) const;

  /// The most that the polynomial follows one height: of one, it passes through it whatever the
  /// others are.
  double most_leverage() const;

  /// The height that is least like what the others tell of it.
  struct Odd {
    Eigen::Index sample;
    double gain;  ///< of twice the log likelihood, if this one may be off by anything
  };
  /// By what each takes of the excess: the square of its weight over its entry of the diagonal of
  /// the inverse (Dubrule 1983). No gain where so few are left free that each takes most of it,
  /// nor, to save the work, where no height is more than `harmless` off the polynomial; else
  /// O(n^3).
  Odd odd_one(const Solution& solution, double harmless) const;

  /// What sums of the solution's heights rest on.
  struct Sums {
    Eigen::MatrixXd influence;  ///< by how much each reading moves each sum: a column
    /// Variance of each sum round the true one if there were no noise, for a roughness of one.
    Eigen::ArrayXd wandering;
  };
  /// Of the heights at `places` times each column of `shares`. O(n^2) for each.
  Sums sums(const Solution& solution, const Eigen::Matrix2Xd& places,
            const Eigen::MatrixXd& shares) const;

 private:
  HeightKriging() = default;

  bool has_slopes() const { return scales_.size() > places_.cols(); }
  /// Of each reading, a row, with the height at each of `places`.
  Eigen::MatrixXd kernels_round(const Eigen::Matrix2Xd& places) const;
  void set_reflectors(Eigen::Index rank);
  void set_kernel(const Eigen::MatrixXd& kernel);
  /// The part off the polynomials in the basis of reduced(), and back.
  Eigen::MatrixXd off_polynomials(const Eigen::MatrixXd& scaled) const;
  Eigen::MatrixXd from_off_polynomials(const Eigen::MatrixXd& reduced) const;
  /// Of the system on the null space, reflected from both sides: for each reading.
  Eigen::ArrayXd diagonal_of_inverse(const Solution& solution) const;

  HeightKernel kernel_ = HeightKernel::kCubic;
  Eigen::Matrix2Xd places_;
  Eigen::ArrayXd scales_;  ///< of the readings
  double level_ = 0.0;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
  Eigen::MatrixXd reflectors_;         ///< V of set_reflectors()
  Eigen::MatrixXd scaled_reflectors_;  ///< V T
  Eigen::MatrixXd basis_;              ///< orthonormal columns that span the polynomial block
  Eigen::MatrixXd on_basis_;           ///< kernel times basis
  Eigen::MatrixXd reduced_;            ///< lower triangle
  Eigen::VectorXd heights_;
  Eigen::VectorXd free_heights_;
};

}  // namespace instep
