#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/fusion/poses/view_matches.h"
#include "core/fusion/views/shared_errors.h"

namespace instep {

/// What is unknown of a view: a turn about its centroid (radians), a shift (mm), and by what shares
/// it is to be deeper and wider.
inline constexpr Eigen::Index kUnknowns = 8;
using UnknownsVector = Eigen::Matrix<double, kUnknowns, 1>;

/// Where those of a view begin among those of all.
inline Eigen::Index first_unknown(std::size_t view) {
  return kUnknowns * static_cast<Eigen::Index>(view);
}

/// How far views may be off before anything is known of them, one sigma.
struct ExpectedErrors {
  double pose_mm = 15.0;
  double pose_deg = 3.0;
  /// Share by which depths may be off, and likewise what lies across them: 0 = exact, else 0.05
  /// to 1 %. By this one simulated feet are told alike well where it is 0, 0.1 and 0.3 %
  /// (tests/bench/poses).
  double lens = 2e-3;
};

/// Of one Gauss-Newton step for the unknowns of all views.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

/// By the distances of the matches, each weighed by its noise and by how far within `reach_mm` it
/// is (Tukey). Singular alone: nothing holds the views together in the station.
NormalEquations equations_of(const std::vector<MovingView>& views,
                             const std::vector<ViewMatch>& matches, double reach_mm);

/// Takes out of the matrix what the noise of normals seems to tell: matches on a level plate say
/// nothing of where it lies along itself, but of normals that are never quite upright each one
/// seems to. `variance`: of a normal's lean, each way (square radians). What is left tells nothing
/// in any direction in which the matches tell no more than that.
void take_out_noise_of_normals(double variance, const std::vector<MovingView>& views,
                               const std::vector<ViewMatch>& matches, double reach_mm,
                               NormalEquations& equations);

/// Adds that the views are off by no more than expected.
void add_expected(const ExpectedErrors& expected, const std::vector<MovingView>& views,
                  NormalEquations& equations);

/// Turns, shifts and stretches each view. How far that moves a point of a foot, at most, mm.
double move_by(const Eigen::VectorXd& step, std::vector<MovingView>& views);

/// How what a view shows moves in the station where its unknowns are off by `off`.
ErrorField error_field(const MovingView& view, const UnknownsVector& off);

/// How far from the middle of a foot its ends are: what turns a view by so much moves them.
inline constexpr double kArmMm = 150.0;

}  // namespace instep
