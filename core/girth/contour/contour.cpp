#include "core/girth/contour/contour.h"

#include <algorithm>
#include <iterator>

#include "core/geometry/plane_vectors.h"
#include "core/geometry/polygon.h"

namespace instep {
namespace {

/// Pieces of a chord that a tape lies on: it leaves the curve at the ends of pieces only.
constexpr int kPiecesUnderTape = 8;
/// Of the area of the hull: twice round is up to two times it, once round no more than one.
constexpr double kOnce = 1.0 + 1e-6;

}  // namespace

double Contour::turn(std::size_t corner) const {
  return turn_between(outward[corner], outward[next(corner)]);
}

bool Contour::goes_round_once() const {
  const double area = signed_area(points);
  return area > 0.0 && area <= kOnce * signed_area(convex_hull(points));
}

double Contour::length() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += chord(i) * (1.0 + turn(i) * turn(i) / 24.0);
  }
  return sum;
}

double Contour::tape_length() const {
  const auto fine = refined(kPiecesUnderTape);
  const auto hull = convex_hull(fine);
  const std::size_t count = hull.size();
  if (count < 3) return perimeter(hull);
  std::vector<Eigen::Vector2d> sides;
  sides.reserve(count);
  for (std::size_t i = 0; i < count; ++i) sides.push_back(hull[(i + 1) % count] - hull[i]);
  std::vector<double> turns;  // from each side to the next
  turns.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    turns.push_back(turn_between(sides[i], sides[(i + 1) % count]));
  }
  // Both run counter-clockwise, so the hull's corners are met one after the other on the curve.
  auto at = std::find(fine.begin(), fine.end(), hull.front());
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& corner = hull[(i + 1) % count];
    const auto next = std::next(at) == fine.end() ? fine.begin() : std::next(at);
    const bool touches = *next == corner;
    at = std::find(next, fine.end(), corner);
    if (at == fine.end()) at = std::find(fine.begin(), next, corner);
    // At a corner the turn is no arc's: the neighbour's tells.
    const double turn = std::min(turns[(i + count - 1) % count], turns[i]);
    sum += sides[i].norm() * (touches ? 1.0 + turn * turn / 24.0 : 1.0);
  }
  // The cubics of a curve without hollows may bend a little more than its arcs.
  return std::min(sum, length());
}

std::vector<Eigen::Vector2d> Contour::refined(int parts) const {
  std::vector<Eigen::Vector2d> fine;
  fine.reserve(points.size() * static_cast<std::size_t>(parts));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t to = next(i);
    const Eigen::Vector2d leave = chord(i) * Eigen::Vector2d(-outward[i].y(), outward[i].x());
    const Eigen::Vector2d arrive = chord(i) * Eigen::Vector2d(-outward[to].y(), outward[to].x());
    for (int k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      const double rest = 1.0 - t;
      fine.push_back(rest * rest * ((1.0 + 2.0 * t) * points[i] + t * leave) +
                     t * t * ((1.0 + 2.0 * rest) * points[to] - rest * arrive));
    }
  }
  return fine;
}

}  // namespace instep
