#include "core/surface/ribbon/ribbon_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "core/median.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

constexpr std::size_t kFewestPoints = 24;
/// Directions that neither the points nor the prices decide.
constexpr double kLeastPrice = 1e-9;
/// Integrals over the width of the squared third derivatives of Legendre's polynomials: those of
/// the fourth and fifth column, the others have none.
constexpr double kCubicRoughness = 450.0;
constexpr double kQuarticRoughness = 7350.0;
/// Those that are the same all round the line cost so much of their price, what changes more by the
/// square of its change from knot to knot. An ellipsoid's are the same all round: priced at each
/// knot by itself, noise of 0.2 mm hid them, and girths were 0.05 mm too long in place of 0.01.
constexpr double kSameAllRound = 0.01;
constexpr double kChanging = 100.0;
/// Columns without a price of their own: a parabola.
constexpr double kFreeTerms = 3.0;
/// Products of the second differences of a knot's term with those of the terms ahead.
constexpr std::array<double, 3> kFourthDifference = {6.0, -4.0, 1.0};

/// Logarithms: prices off the plane that are tried, of which the largest leaves a parabola; the
/// first price along the line; steps in which that is looked for, first and without strays.
constexpr std::array<double, 3> kOffPrices = {-3.0, 3.0, -9.0};
constexpr double kFirstAlong = 2.0;
constexpr double kFirstStep = 3.0;
constexpr double kLastStep = 0.75;
constexpr double kLeastAlong = -14.0;
constexpr double kMostAlong = 20.0;

/// In standard deviations: from there on a point counts less, and not at all.
constexpr double kFarOff = 2.5;
constexpr double kStray = 6.0;

/// From the power of none on.
template <int kCount>
Eigen::Matrix<double, kCount, 1> powers_of(double value) {
  Eigen::Matrix<double, kCount, 1> powers;
  powers[0] = 1.0;
  for (int i = 1; i < kCount; ++i) powers[i] = powers[i - 1] * value;
  return powers;
}

/// Of two cubic polynomials, told by their factors of rising powers.
Eigen::Matrix<double, 7, 1> product_of(const Eigen::RowVector4d& one,
                                       const Eigen::RowVector4d& other) {
  Eigen::Matrix<double, 7, 1> product = Eigen::Matrix<double, 7, 1>::Zero();
  for (int i = 0; i < 4; ++i) product.segment<4>(i) += one[i] * other.transpose();
  return product;
}

}  // namespace

RibbonSpline::RibbonSpline(double length, int knots)
    : basis_(length, kKnotsInBlock * std::max(3, (knots + 1) / kKnotsInBlock)) {}

/// Sums over points, a row for each power of what they are off the plane and a column for each
/// power of their part of the way: nothing else of a point matters.
struct RibbonSpline::Moments {
  Eigen::Matrix<double, Powers::SizeAtCompileTime, 7> certainties = decltype(certainties)::Zero();
  Eigen::Matrix<double, kColumns + 1, 4> heights = decltype(heights)::Zero();
};

/// Legendre's polynomials: a row for each, its factors of rising powers.
RibbonSpline::Square RibbonSpline::legendre() {
  Square factors;
  factors << 1.0, 0.0, 0.0, 0.0, 0.0,  //
      0.0, 1.0, 0.0, 0.0, 0.0,         //
      -0.5, 0.0, 1.5, 0.0, 0.0,        //
      0.0, -1.5, 0.0, 2.5, 0.0,        //
      0.375, 0.0, -3.75, 0.0, 4.375;
  return factors;
}

/// Adds what a knot's terms have with those of the one so many ahead: to both of its places where
/// they share a block.
void RibbonSpline::add_ahead(std::size_t knot, int ahead, const Square& square, System& system) {
  const std::size_t block = knot / kKnotsInBlock;
  const int row = static_cast<int>(knot % kKnotsInBlock) * kColumns;
  const int other = static_cast<int>(knot % kKnotsInBlock) + ahead;
  const int column = other % kKnotsInBlock * kColumns;
  if (other >= kKnotsInBlock) {
    system.next[block].block<kColumns, kColumns>(row, column) += square;
    return;
  }
  system.own[block].block<kColumns, kColumns>(row, column) += square;
  if (ahead > 0) system.own[block].block<kColumns, kColumns>(column, row) += square;
}

/// Of Legendre's polynomials with each other, from sums of the powers of what they are taken at.
RibbonSpline::Square RibbonSpline::products_of_columns(const Powers& powers) {
  Square products;
  for (int i = 0; i < kColumns; ++i) products.col(i) = powers.segment<kColumns>(i);
  return legendre() * products * legendre().transpose();
}

std::vector<RibbonSpline::Moments> RibbonSpline::moments_of(const std::vector<RibbonPoint>& points,
                                                            Evidence& evidence) const {
  std::vector<Moments> moments(static_cast<std::size_t>(basis_.knots()));
  for (const auto& point : points) {
    if (!(point.certainty > 0.0)) continue;
    const auto [knot, part] = basis_.place_of(point.way);
    const auto along = powers_of<7>(part);
    const Powers off = point.certainty * powers_of<Powers::SizeAtCompileTime>(point.off);
    Moments& here = moments[static_cast<std::size_t>(knot)];
    here.certainties.noalias() += off * along.transpose();
    here.heights.noalias() += point.height * off.head<kColumns + 1>() * along.head<4>().transpose();
    evidence.squares += point.certainty * point.height * point.height;
    evidence.count += 1.0;
  }
  return moments;
}

RibbonSpline::Evidence RibbonSpline::evidence_of(const std::vector<RibbonPoint>& points) const {
  const auto knots = static_cast<std::size_t>(basis_.knots());
  Evidence evidence{{}, Eigen::VectorXd::Zero(basis_.knots() * kColumns)};
  const auto moments = moments_of(points, evidence);
  // Of each knot with itself and the three ahead of it.
  std::vector<std::array<Powers, 4>> ahead(
      knots, {Powers::Zero(), Powers::Zero(), Powers::Zero(), Powers::Zero()});
  const Eigen::Matrix4d splines = ClosedSplineBasis::polynomials();
  for (std::size_t from = 0; from < knots; ++from) {
    const auto terms = basis_.terms_from(static_cast<Eigen::Index>(from));
    const Piece heights = moments[from].heights.topRows<kColumns>().transpose();
    for (Eigen::Index i = 0; i < 4; ++i) {
      const Eigen::Index term = terms[static_cast<std::size_t>(i)];
      evidence.right.segment<kColumns>(term * kColumns) +=
          legendre() * (splines.row(i) * heights).transpose();
      auto& products = ahead[static_cast<std::size_t>(term)];
      for (Eigen::Index j = i; j < 4; ++j) {
        products[static_cast<std::size_t>(j - i)] +=
            moments[from].certainties * product_of(splines.row(i), splines.row(j));
      }
    }
  }
  evidence.products.own.assign(knots / kKnotsInBlock, System::Block::Zero());
  evidence.products.next.assign(knots / kKnotsInBlock, System::Block::Zero());
  for (std::size_t knot = 0; knot < knots; ++knot) {
    for (int i = 0; i < 4; ++i) {
      const Powers& powers = ahead[knot][static_cast<std::size_t>(i)];
      add_ahead(knot, i, products_of_columns(powers), evidence.products);
    }
  }
  return evidence;
}

void RibbonSpline::Evidence::take(const Evidence& less) {
  for (std::size_t i = 0; i < products.own.size(); ++i) {
    products.own[i] -= less.products.own[i];
    products.next[i] -= less.products.next[i];
  }
  right -= less.right;
  squares -= less.squares;
}

void RibbonSpline::add_prices(const Prices& prices, System& system) const {
  const double along = std::exp(prices.along);
  const double off = std::exp(prices.off);
  Columns rough = Columns::Zero();
  rough[3] = kCubicRoughness * off;
  rough[4] = kQuarticRoughness * off;
  const auto priced = [&](double own, double bending, double roughness) -> Square {
    const Columns even = Columns::Constant(own + bending * along);
    return (even + roughness * rough).asDiagonal();
  };
  const Square here = priced(kLeastPrice, kFourthDifference[0], kSameAllRound + 2.0 * kChanging);
  const Square next = priced(0.0, kFourthDifference[1], -kChanging);
  const Square second = priced(0.0, kFourthDifference[2], 0.0);
  for (std::size_t knot = 0; knot < static_cast<std::size_t>(basis_.knots()); ++knot) {
    add_ahead(knot, 0, here, system);
    add_ahead(knot, 1, next, system);
    add_ahead(knot, 2, second, system);
  }
}

/// Logarithm of the product of all prices that are not zero: the waves round the line each have
/// theirs.
double RibbonSpline::log_price(const Prices& prices) const {
  const double along = std::exp(prices.along);
  const double off = std::exp(prices.off);
  const std::array<double, 3> rough = {0.0, kCubicRoughness * off, kQuarticRoughness * off};
  const std::array<double, 3> times = {kFreeTerms, 1.0, 1.0};
  double sum = std::log(kSameAllRound * rough[1]) + std::log(kSameAllRound * rough[2]);
  for (Eigen::Index wave = 1; wave < basis_.knots(); ++wave) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(wave) / static_cast<double>(basis_.knots());
    const double bend = 2.0 - 2.0 * std::cos(angle);
    const double changing = kSameAllRound + kChanging * bend;
    for (std::size_t i = 0; i < rough.size(); ++i) {
      sum += times[i] * std::log(along * bend * bend + changing * rough[i]);
    }
  }
  return sum;
}

/// With minus twice the logarithm of the restricted likelihood, but for a constant, with the
/// likeliest noise. Nothing where the points and the prices do not determine the terms.
std::optional<RibbonSpline::Fit> RibbonSpline::fit(const Evidence& evidence,
                                                   const Prices& prices) const {
  System system = evidence.products;
  add_prices(prices, system);
  auto cholesky = Cholesky::of(system);
  if (!cholesky) return std::nullopt;
  Eigen::VectorXd terms = cholesky->solve(evidence.right);
  const double left = evidence.squares - evidence.right.dot(terms);
  if (!(left > 0.0)) return std::nullopt;
  const double unlikelihood = (evidence.count - kFreeTerms) * std::log(left) +
                              cholesky->log_determinant() - log_price(prices);
  return Fit{prices, std::move(*cholesky), std::move(terms), left, unlikelihood};
}

/// Takes the fit at other prices if it is likelier; tells how unlikely it is.
double RibbonSpline::try_prices(const Evidence& evidence, const Prices& prices, Fit& best) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (prices.along < kLeastAlong || prices.along > kMostAlong) return kNever;
  auto tried = fit(evidence, prices);
  if (!tried) return kNever;
  const double unlikelihood = tried->unlikelihood;
  if (unlikelihood < best.unlikelihood) best = std::move(*tried);
  return unlikelihood;
}

/// In steps until those beside the best are less likely, then to the lowest place of the parabola
/// through the three, in whole steps of the last size: so rounding does not move a price.
void RibbonSpline::improve_along(const Evidence& evidence, double step, Fit& best) const {
  const auto at = [&, off = best.prices.off](double along) {
    return try_prices(evidence, {along, off}, best);
  };
  double along = best.prices.along;
  double here = best.unlikelihood;
  double below = at(along - step);
  double above = at(along + step);
  while (best.prices.along != along) {
    const bool down = best.prices.along < along;
    (down ? above : below) = here;
    along = best.prices.along;
    here = best.unlikelihood;
    (down ? below : above) = at(down ? along - step : along + step);
  }
  const double bend = below - 2.0 * here + above;
  const double moves = std::round(0.5 * step * (below - above) / bend / kLastStep);
  if (std::isfinite(moves) && moves != 0.0) at(along + moves * kLastStep);
}

/// The likeliest price along the line hardly depends on that off the plane.
std::optional<RibbonSpline::Fit> RibbonSpline::likeliest(const Evidence& evidence) const {
  std::optional<Fit> best;
  for (const double off : kOffPrices) {
    if (!best) {
      best = fit(evidence, {kFirstAlong, off});
    } else {
      try_prices(evidence, {best->prices.along, off}, *best);
    }
    if (best && best->prices.off == off) improve_along(evidence, kFirstStep, *best);
  }
  return best;
}

bool RibbonSpline::settle(std::optional<Fit> fit, double count) {
  if (!fit) return false;
  fit_ = std::move(fit);
  sigma_ = std::sqrt(fit_->left / (count - kFreeTerms));
  set_pieces();
  return sigma_ > 0.0;
}

void RibbonSpline::set_pieces() {
  const Eigen::Matrix4d splines = ClosedSplineBasis::polynomials();
  pieces_.assign(static_cast<std::size_t>(basis_.knots()), Piece::Zero());
  for (std::size_t from = 0; from < pieces_.size(); ++from) {
    const auto terms = basis_.terms_from(static_cast<Eigen::Index>(from));
    for (Eigen::Index i = 0; i < 4; ++i) {
      const Eigen::Index row = terms[static_cast<std::size_t>(i)] * kColumns;
      pieces_[from] += splines.row(i).transpose() *
                       (fit_->terms.segment<kColumns>(row).transpose() * legendre());
    }
  }
}

RibbonSpline::Evidence RibbonSpline::without_strays(Evidence evidence,
                                                    const std::vector<RibbonPoint>& points) const {
  std::vector<double> off;
  off.reserve(points.size());
  for (const auto& point : points) {
    off.push_back(std::abs(point.height - at(point.way, point.off).value) *
                  std::sqrt(point.certainty));
  }
  const double sigma = kSigmaInMedians * median(off);
  // Few points count less: what they no longer count is taken from what all say.
  std::vector<RibbonPoint> less;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(off[i] > kFarOff * sigma)) continue;
    const bool is_stray = off[i] > kStray * sigma;
    less.push_back(points[i]);
    if (!is_stray) less.back().certainty *= 1.0 - kFarOff * sigma / off[i];
    if (is_stray) evidence.count -= 1.0;
  }
  evidence.take(evidence_of(less));
  return evidence;
}

std::optional<RibbonSpline> RibbonSpline::through(const std::vector<RibbonPoint>& points,
                                                  double length, int knots) {
  if (points.size() < kFewestPoints) return std::nullopt;
  RibbonSpline spline(length, knots);
  const Evidence first = spline.evidence_of(points);
  if (!spline.settle(spline.likeliest(first), first.count)) return std::nullopt;
  const Evidence second = spline.without_strays(first, points);
  if (second.count < kFewestPoints) return std::nullopt;
  auto best = spline.fit(second, spline.fit_->prices);
  if (best) spline.improve_along(second, kLastStep, *best);
  if (!spline.settle(std::move(best), second.count)) return std::nullopt;
  return spline;
}

RibbonSpline::Height RibbonSpline::at(double way, double off) const {
  const auto [knot, part] = basis_.place_of(way);
  const Eigen::Vector4d cubic = pieces_[static_cast<std::size_t>(knot)] * powers_of<kColumns>(off);
  const double slope = cubic[1] + part * (2.0 * cubic[2] + part * 3.0 * cubic[3]);
  return {cubic[0] + part * (cubic[1] + part * (cubic[2] + part * cubic[3])),
          slope / basis_.knots_apart()};
}

double RibbonSpline::variance_of_sum(const std::vector<double>& ways,
                                     const std::vector<double>& shares) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(fit_->terms.size());
  const Columns columns = legendre().col(0);  // on the plane
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto spot = basis_.at(ways[i]);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Index row = spot.terms[static_cast<std::size_t>(k)] * kColumns;
      sum.segment<kColumns>(row) += shares[i] * spot.values[k] * columns;
    }
  }
  return sigma_ * sigma_ * sum.dot(fit_->cholesky.solve(sum));
}

double RibbonSpline::bending() const {
  return sigma_ * std::exp(-0.5 * fit_->prices.along);
}

}  // namespace instep
