#include "core/girth/contour/fair_line.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

constexpr double kFewestKnots = 8.0;
constexpr int kCornersFromKnotToKnot = 4;
/// Of Newton's method from the nearest corner to a foot. After one, feet are off by up to 4e-4 of
/// the section, which shows where some points are exact.
constexpr int kMoves = 2;
/// A foot is looked for as if the point were no further than half-way to where the line bends
/// round.
constexpr double kLeastPull = 0.5;

/// The terms of the curve nearest to the contour, a row for each.
Eigen::MatrixX2d terms_nearest_to(const Contour& contour, const ClosedSplineBasis& basis) {
  const Eigen::Index knots = basis.knots();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(knots, knots);
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(knots, 2);
  const std::size_t count = contour.points.size();
  double way = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    // Each corner stands for half of the chords beside it.
    const double before = contour.chord(i > 0 ? i - 1 : count - 1);
    const double after = contour.chord(i);
    const double share = 0.5 * (before + after);
    const auto spot = basis.at(way);
    for (int a = 0; a < 4; ++a) {
      const Eigen::Index row = spot.terms[static_cast<std::size_t>(a)];
      right.row(row) += share * spot.values[a] * contour.points[i].transpose();
      for (int b = 0; b < 4; ++b) {
        products(row, spot.terms[static_cast<std::size_t>(b)]) +=
            share * spot.values[a] * spot.values[b];
      }
    }
    way += after;
  }
  return products.ldlt().solve(right);
}

}  // namespace

FairLine::FairLine(const ClosedSplineBasis& basis, const Eigen::MatrixX2d& terms)
    : basis_(basis), pieces_(pieces_of(basis, terms)), corners_(corners_on_it()) {}

std::vector<FairLine::Piece> FairLine::pieces_of(const ClosedSplineBasis& basis,
                                                 const Eigen::MatrixX2d& terms) {
  const Eigen::Matrix4d polynomials = ClosedSplineBasis::polynomials();
  std::vector<Piece> pieces;
  for (Eigen::Index knot = 0; knot < basis.knots(); ++knot) {
    const auto numbers = basis.terms_from(knot);
    Piece piece = Piece::Zero();
    for (Eigen::Index i = 0; i < 4; ++i) {
      piece += terms.row(numbers[static_cast<std::size_t>(i)]).transpose() * polynomials.row(i);
    }
    pieces.push_back(piece);
  }
  return pieces;
}

std::vector<Eigen::Vector2d> FairLine::corners_on_it() const {
  std::vector<Eigen::Vector2d> corners;
  const auto count = kCornersFromKnotToKnot * static_cast<int>(basis_.knots());
  for (int i = 0; i < count; ++i) corners.push_back(at(length() * i / count).point);
  return corners;
}

std::optional<FairLine> FairLine::through(const Contour& contour, double knots_apart) {
  const double length = perimeter(contour.points);
  if (!(length >= kFewestKnots * knots_apart)) return std::nullopt;
  const ClosedSplineBasis basis(length, std::lround(length / knots_apart));
  const Eigen::MatrixX2d terms = terms_nearest_to(contour, basis);
  if (!terms.allFinite()) return std::nullopt;
  return FairLine(basis, terms);
}

FairLine::Curve FairLine::curve_at(double way) const {
  const auto [knot, t] = basis_.place_of(way);
  const Piece& piece = pieces_[static_cast<std::size_t>(knot)];
  const double apart = basis_.knots_apart();
  return {piece * Eigen::Vector4d(1.0, t, t * t, t * t * t),
          piece.rightCols<3>() * Eigen::Vector3d(1.0, 2.0 * t, 3.0 * t * t) / apart,
          piece.rightCols<2>() * Eigen::Vector2d(2.0, 6.0 * t) / (apart * apart)};
}

FairLine::Place FairLine::at(double way) const {
  const Curve curve = curve_at(way);
  return {curve.point, curve.tangent,
          Eigen::Vector2d(curve.tangent.y(), -curve.tangent.x()).normalized()};
}

FairLine::Foot FairLine::foot_of(const Eigen::Vector2d& point) const {
  const double apart = basis_.knots_apart() / kCornersFromKnotToKnot;
  double way = apart * static_cast<double>(corners_.nearest_corner(point));
  for (int move = 0; move < kMoves; ++move) {
    const Curve near = curve_at(way);
    const Eigen::Vector2d aside = point - near.point;
    const double squared = near.tangent.squaredNorm();
    way += aside.dot(near.tangent) / std::max(squared - aside.dot(near.bend), kLeastPull * squared);
  }
  const Place place = at(way);
  const Eigen::Vector2d offset = point - place.point;
  return {way, place.outward.dot(offset), offset.norm()};
}

}  // namespace instep
