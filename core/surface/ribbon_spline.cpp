#include "core/surface/ribbon_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "core/median.h"

namespace instep {
namespace {

constexpr std::size_t kFewestPoints = 24;
/// Directions that neither the points nor the prices decide.
constexpr double kLeastPrice = 1e-9;
/// Integrals over the width of the squared third derivatives of Legendre's polynomials: those of
/// the fourth and fifth column, the others have none.
constexpr double kCubicRoughness = 450.0;
constexpr double kQuarticRoughness = 7350.0;
/// Columns without a price of their own: a parabola.
constexpr double kFreeTerms = 3.0;
/// Products of the second differences of a knot's term with those of the terms ahead.
constexpr std::array<double, 3> kFourthDifference = {6.0, -4.0, 1.0};

/// Logarithms: prices off the plane that are tried, from a parabola to nearly free; the first price
/// along the line; steps in which that is looked for.
constexpr std::array<double, 3> kOffPrices = {3.0, -3.0, -9.0};
constexpr double kFirstAlong = 2.0;
constexpr std::array<double, 3> kSteps = {3.0, 1.5, 0.75};
constexpr double kLeastAlong = -14.0;
constexpr double kMostAlong = 20.0;

/// In standard deviations: from there on a point counts less, and not at all.
constexpr double kFarOff = 2.5;
constexpr double kStray = 6.0;
constexpr double kSigmaOfMedian = 1.4826;

}  // namespace

RibbonSpline::RibbonSpline(double length, int knots)
    : basis_(length, kKnotsInBlock * std::max(3, (knots + 1) / kKnotsInBlock)) {}

/// Legendre's polynomials.
RibbonSpline::Columns RibbonSpline::columns_at(double off) {
  Columns columns;
  columns[0] = 1.0;
  columns[1] = off;
  for (int i = 2; i < kColumns; ++i) {
    columns[i] = ((2 * i - 1) * off * columns[i - 1] - (i - 1) * columns[i - 2]) / i;
  }
  return columns;
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
  Square legendre;
  legendre << 1.0, 0.0, 0.0, 0.0, 0.0,  //
      0.0, 1.0, 0.0, 0.0, 0.0,          //
      -0.5, 0.0, 1.5, 0.0, 0.0,         //
      0.0, -1.5, 0.0, 2.5, 0.0,         //
      0.375, 0.0, -3.75, 0.0, 4.375;
  Square products;
  for (int i = 0; i < kColumns; ++i) products.col(i) = powers.segment<kColumns>(i);
  return legendre * products * legendre.transpose();
}

RibbonSpline::Evidence RibbonSpline::evidence_of(const std::vector<RibbonPoint>& points) const {
  const auto knots = static_cast<std::size_t>(basis_.knots());
  // Of each knot with itself and the three ahead of it.
  std::vector<std::array<Powers, 4>> ahead(
      knots, {Powers::Zero(), Powers::Zero(), Powers::Zero(), Powers::Zero()});
  Evidence evidence{{}, Eigen::VectorXd::Zero(basis_.knots() * kColumns)};
  for (const auto& point : points) {
    if (!(point.certainty > 0.0)) continue;
    const auto spot = basis_.at(point.way);
    const Columns columns = point.certainty * point.height * columns_at(point.off);
    Powers powers;
    powers[0] = point.certainty;
    for (int i = 1; i < kPowers; ++i) powers[i] = powers[i - 1] * point.off;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto knot = static_cast<std::size_t>(spot.terms[i]);
      const double value = spot.values[static_cast<Eigen::Index>(i)];
      evidence.right.segment<kColumns>(spot.terms[i] * kColumns) += value * columns;
      for (std::size_t j = i; j < 4; ++j) {
        ahead[knot][j - i] += value * spot.values[static_cast<Eigen::Index>(j)] * powers;
      }
    }
    evidence.squares += point.certainty * point.height * point.height;
    evidence.count += 1.0;
  }
  const std::size_t blocks = knots / kKnotsInBlock;
  evidence.products.own.assign(blocks, System::Block::Zero());
  evidence.products.next.assign(blocks, System::Block::Zero());
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
  Columns own = Columns::Constant(kLeastPrice + kFourthDifference[0] * along);
  own[3] += kCubicRoughness * off;
  own[4] += kQuarticRoughness * off;
  const Square here = own.asDiagonal();
  for (std::size_t knot = 0; knot < static_cast<std::size_t>(basis_.knots()); ++knot) {
    add_ahead(knot, 0, here, system);
    for (int ahead = 1; ahead < 3; ++ahead) {
      add_ahead(knot, ahead,
                kFourthDifference[static_cast<std::size_t>(ahead)] * along * Square::Identity(),
                system);
    }
  }
}

std::optional<RibbonSpline::Cholesky> RibbonSpline::solved(const Evidence& evidence,
                                                           const Prices& prices) const {
  System system = evidence.products;
  add_prices(prices, system);
  return Cholesky::of(system);
}

/// Logarithm of the product of all prices that are not zero: the waves round the line each have
/// theirs.
double RibbonSpline::log_price(const Prices& prices) const {
  const double along = std::exp(prices.along);
  const double off = std::exp(prices.off);
  const std::array<double, 3> own = {0.0, kCubicRoughness * off, kQuarticRoughness * off};
  const std::array<double, 3> times = {kFreeTerms, 1.0, 1.0};
  double sum = std::log(own[1]) + std::log(own[2]);
  for (Eigen::Index wave = 1; wave < basis_.knots(); ++wave) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(wave) / static_cast<double>(basis_.knots());
    const double bend = 2.0 - 2.0 * std::cos(angle);
    for (std::size_t i = 0; i < own.size(); ++i) {
      sum += times[i] * std::log(along * bend * bend + own[i]);
    }
  }
  return sum;
}

/// Minus twice the logarithm of the restricted likelihood, but for a constant, with the likeliest
/// noise.
double RibbonSpline::unlikelihood(const Evidence& evidence, const Prices& prices) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto cholesky = solved(evidence, prices);
  if (!cholesky) return kNever;
  const double left = evidence.squares - evidence.right.dot(cholesky->solve(evidence.right));
  if (!(left > 0.0)) return kNever;
  return (evidence.count - kFreeTerms) * std::log(left) + cholesky->log_determinant() -
         log_price(prices);
}

/// Goes on in one direction while that gets likelier.
void RibbonSpline::improve_along(const Evidence& evidence, double step, Prices& prices,
                                 double& unlikely) const {
  for (const double move : {step, -step}) {
    bool moved = false;
    for (;;) {
      const Prices tried{std::clamp(prices.along + move, kLeastAlong, kMostAlong), prices.off};
      if (tried.along == prices.along) break;
      const double there = unlikelihood(evidence, tried);
      if (!(there < unlikely)) break;
      prices = tried;
      unlikely = there;
      moved = true;
    }
    if (moved) return;
  }
}

RibbonSpline::Prices RibbonSpline::likeliest(const Evidence& evidence) const {
  Prices best{kFirstAlong, kOffPrices.front()};
  double least = std::numeric_limits<double>::infinity();
  for (const double off : kOffPrices) {
    Prices prices{best.along, off};
    double unlikely = unlikelihood(evidence, prices);
    improve_along(evidence, kSteps.front(), prices, unlikely);
    if (!(unlikely < least)) continue;
    least = unlikely;
    best = prices;
  }
  for (const double step : kSteps) improve_along(evidence, step, best, least);
  return best;
}

bool RibbonSpline::settle(const Evidence& evidence, const Prices& prices) {
  prices_ = prices;
  cholesky_ = solved(evidence, prices);
  if (!cholesky_) return false;
  terms_ = cholesky_->solve(evidence.right);
  const double left = evidence.squares - evidence.right.dot(terms_);
  sigma_ = std::sqrt(left / (evidence.count - kFreeTerms));
  return sigma_ > 0.0;
}

RibbonSpline::Evidence RibbonSpline::without_strays(Evidence evidence,
                                                    const std::vector<RibbonPoint>& points) const {
  std::vector<double> off;
  off.reserve(points.size());
  for (const auto& point : points) {
    off.push_back(std::abs(point.height - height(point.way, point.off).value) *
                  std::sqrt(point.certainty));
  }
  const double sigma = kSigmaOfMedian * median(off);
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
  if (!spline.settle(first, spline.likeliest(first))) return std::nullopt;
  const Evidence second = spline.without_strays(first, points);
  if (second.count < kFewestPoints) return std::nullopt;
  Prices prices = spline.prices_;
  double unlikely = spline.unlikelihood(second, prices);
  spline.improve_along(second, kSteps.back(), prices, unlikely);
  if (!spline.settle(second, prices)) return std::nullopt;
  return spline;
}

RibbonSpline::Height RibbonSpline::at(double way) const {
  return height(way, 0.0);
}

RibbonSpline::Height RibbonSpline::height(double way, double off) const {
  const auto spot = basis_.at(way);
  const Columns columns = columns_at(off);
  Height read;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Index row = spot.terms[static_cast<std::size_t>(i)] * kColumns;
    const double term = columns.dot(terms_.segment<kColumns>(row));
    read.value += spot.values[i] * term;
    read.slope += spot.slopes[i] * term;
  }
  return read;
}

double RibbonSpline::variance_of_sum(const std::vector<double>& ways,
                                     const std::vector<double>& shares) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(terms_.size());
  const Columns columns = columns_at(0.0);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto spot = basis_.at(ways[i]);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Index row = spot.terms[static_cast<std::size_t>(k)] * kColumns;
      sum.segment<kColumns>(row) += shares[i] * spot.values[k] * columns;
    }
  }
  return sigma_ * sigma_ * sum.dot(cholesky_->solve(sum));
}

double RibbonSpline::bending() const {
  return sigma_ * std::exp(-0.5 * prices_.along);
}

}  // namespace instep
