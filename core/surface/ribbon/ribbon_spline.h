#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/surface/ribbon/closed_spline_basis.h"
#include "core/surface/ribbon/cyclic_cholesky.h"

namespace instep {

/// A point of skin as a closed line on a plane sees it.
struct RibbonPoint {
  double way = 0.0;        ///< along the line
  double off = 0.0;        ///< off the plane, against the ribbon's half width: from -1 to 1
  double height = 0.0;     ///< over the line
  double certainty = 1.0;  ///< the inverse of its variance, against those of the others
};

/// The ribbon of skin to both sides of a closed line on a plane, as heights over the line: along it
/// cubic splines on even knots, off the plane a polynomial of the fourth degree. One smooth surface
/// from all points of the ribbon, where a patch has some tens of them.
///
/// What the heights may do is paid for: bends along the line by their squared second differences,
/// and what is more than a parabola off the plane by its squared third derivative, little where
/// that is the same all round the line and more the faster it changes. Both prices, and the noise,
/// are the likeliest ones (restricted maximum likelihood; Wood, Generalized Additive Models, 2017,
/// 6.2), which is kriging with a prior of that form: the same reading gives the variance of what is
/// read off. Points that lie apart count less (Huber's weights).
///
/// An immutable value; results scale with the unit of way and height.
class RibbonSpline {
 public:
  /// Places along the line closer than `length` / `knots` are not told apart; `knots` is rounded to
  /// a multiple of three, nine at least. Nothing if the points are too few or do not determine the
  /// heights, or have no noise at all. O(points + 12 x knots).
  static std::optional<RibbonSpline> through(const std::vector<RibbonPoint>& points, double length,
                                             int knots);

  struct Height {
    double value = 0.0;
    double slope = 0.0;  ///< along the line
  };
  /// On the plane, or so far off it as RibbonPoint has it.
  Height at(double way, double off = 0.0) const;

  /// Variance of a sum of heights on the plane, each times its share.
  double variance_of_sum(const std::vector<double>& ways, const std::vector<double>& shares) const;

  /// Standard deviation of a point of certainty one.
  double sigma() const { return sigma_; }

  /// Standard deviation of the second differences of the heights from knot to knot: how much the
  /// skin bends that the line does not.
  double bending() const;

 private:
  static constexpr int kColumns = 5;
  static constexpr int kKnotsInBlock = 3;
  static constexpr int kSide = kColumns * kKnotsInBlock;
  using Columns = Eigen::Matrix<double, kColumns, 1>;
  using Square = Eigen::Matrix<double, kColumns, kColumns>;
  /// Those of what the columns are taken at that products of two have, and one more: they are
  /// summed in pairs.
  using Powers = Eigen::Matrix<double, 2 * kColumns, 1>;
  /// From a knot to the next the heights are a polynomial of the part of the way (a row for each
  /// power) and of what is off the plane.
  using Piece = Eigen::Matrix<double, 4, kColumns>;
  using System = CyclicSystem<kSide>;
  using Cholesky = CyclicCholesky<kSide>;

  /// Logarithms of the prices against the noise.
  struct Prices {
    double along = 0.0;
    double off = 0.0;
  };

  /// What the points say, whatever the prices.
  struct Evidence {
    System products;
    Eigen::VectorXd right;
    double squares = 0.0;
    double count = 0.0;  ///< of points

    /// Takes what other points say from it; not their number.
    void take(const Evidence& less);
  };

  /// What they make of it at some prices.
  struct Fit {
    Prices prices;
    Cholesky cholesky;
    Eigen::VectorXd terms;  ///< of the columns, knot by knot
    double left = 0.0;      ///< squares that the terms leave, and pay
    double unlikelihood = 0.0;
  };

  RibbonSpline(double length, int knots);

  /// What the points from a knot to the next say.
  struct Moments;

  static Square legendre();
  static Square products_of_columns(const Powers& powers);
  static void add_ahead(std::size_t knot, int ahead, const Square& square, System& system);
  std::vector<Moments> moments_of(const std::vector<RibbonPoint>& points, Evidence& evidence) const;
  Evidence evidence_of(const std::vector<RibbonPoint>& points) const;
  void add_prices(const Prices& prices, System& system) const;
  std::optional<Fit> fit(const Evidence& evidence, const Prices& prices) const;
  double log_price(const Prices& prices) const;
  double try_prices(const Evidence& evidence, const Prices& prices, Fit& best) const;
  void improve_along(const Evidence& evidence, double step, Fit& best) const;
  std::optional<Fit> likeliest(const Evidence& evidence) const;
  bool settle(std::optional<Fit> fit, double count);
  void set_pieces();
  Evidence without_strays(Evidence evidence, const std::vector<RibbonPoint>& points) const;

  ClosedSplineBasis basis_;
  std::optional<Fit> fit_;
  std::vector<Piece> pieces_;  ///< its terms, from knot to knot
  double sigma_ = 0.0;
};

}  // namespace instep
