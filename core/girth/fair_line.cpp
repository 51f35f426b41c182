#include "core/girth/fair_line.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <cstddef>

namespace instep {
namespace {

constexpr double kFewestKnots = 8.0;

}  // namespace

FairLine::FairLine(const Contour& contour, Eigen::Index knots)
    : corners_(contour), basis_(corners_.length(), knots) {
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(knots, knots);
  terms_ = Eigen::MatrixX2d::Zero(knots, 2);
  const std::size_t count = contour.points.size();
  double way = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    // Each corner stands for half of the chords beside it.
    const double before = (contour.points[i] - contour.points[(i + count - 1) % count]).norm();
    const double after = (contour.points[(i + 1) % count] - contour.points[i]).norm();
    const double share = 0.5 * (before + after);
    const auto spot = basis_.at(way);
    for (int a = 0; a < 4; ++a) {
      const Eigen::Index row = spot.terms[static_cast<std::size_t>(a)];
      terms_.row(row) += share * spot.values[a] * contour.points[i].transpose();
      for (int b = 0; b < 4; ++b) {
        products(row, spot.terms[static_cast<std::size_t>(b)]) +=
            share * spot.values[a] * spot.values[b];
      }
    }
    way += after;
  }
  terms_ = products.ldlt().solve(terms_).eval();
}

std::optional<FairLine> FairLine::through(const Contour& contour, double knots_apart) {
  const double knots = contour.length() / knots_apart;
  if (!(knots >= kFewestKnots)) return std::nullopt;
  FairLine line(contour, static_cast<Eigen::Index>(std::lround(knots)));
  if (!line.terms_.allFinite()) return std::nullopt;
  return line;
}

FairLine::Place FairLine::at(double way) const {
  const auto spot = basis_.at(way);
  Place place{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d term = terms_.row(spot.terms[static_cast<std::size_t>(i)]);
    place.point += spot.values[i] * term;
    place.tangent += spot.slopes[i] * term;
  }
  place.outward = Eigen::Vector2d(place.tangent.y(), -place.tangent.x()).normalized();
  return place;
}

FairLine::Foot FairLine::foot_of(const Eigen::Vector2d& point) const {
  double way = corners_.foot_of(point).way;
  const Place near = at(way);
  // The foot on the corners is so near to the one on the curve that one move is enough.
  way += (point - near.point).dot(near.tangent) / near.tangent.squaredNorm();
  const Place place = at(way);
  const Eigen::Vector2d offset = point - place.point;
  return {way, place.outward.dot(offset), offset.norm()};
}

}  // namespace instep
