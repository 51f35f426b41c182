#include "core/girth/contour_trace.h"

#include <algorithm>
#include <cmath>

namespace instep {
namespace {

constexpr int kMostCorrections = 12;
/// A last move of Newton that is shorter, in steps, leaves an error of its square.
constexpr double kLastMove = 1e-5;
/// A step that turns further is halved, down to this part of the full step.
constexpr double kLargestTurn = 0.2;
constexpr double kShortestStep = 1.0 / 64.0;
/// Least slope within the plane: below it the surface runs along the plane.
constexpr double kLeastSlope = 0.05;

struct Place {
  Eigen::Vector2d point;
  Eigen::Vector2d outward;  ///< unit length
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double turn_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(cross(a, b), a.dot(b));
}

/// Newton along the gradient to the zero line, moving no further than `reach`.
std::optional<Place> correct(BlendedSurface& surface, const Eigen::Vector2d& start, double reach) {
  Eigen::Vector2d point = start;
  for (int i = 0; i < kMostCorrections; ++i) {
    const Eigen::Vector3d place(point.x(), point.y(), 0.0);
    if (!surface.visit(place)) return std::nullopt;
    const auto field = surface.at(place);
    if (!field) return std::nullopt;
    const Eigen::Vector2d slope = field->gradient.head<2>();
    if (!(slope.norm() > kLeastSlope)) return std::nullopt;
    const Eigen::Vector2d move = -field->value / slope.squaredNorm() * slope;
    point += move;
    if (!((point - start).norm() <= reach)) return std::nullopt;
    if (move.norm() < kLastMove * reach) return Place{point, slope.normalized()};
  }
  return std::nullopt;
}

/// One step onwards, as long as the bend allows.
std::optional<Place> advance(BlendedSurface& surface, const Place& from, double step) {
  const Eigen::Vector2d along(-from.outward.y(), from.outward.x());
  for (double length = step; length >= kShortestStep * step; length *= 0.5) {
    const auto next = correct(surface, from.point + length * along, 0.7 * length);
    if (!next) continue;
    const bool shortest = length < 2.0 * kShortestStep * step;
    const double turn = std::abs(turn_between(from.outward, next->outward));
    if (turn <= kLargestTurn || (shortest && turn < 1.5)) return next;
  }
  return std::nullopt;
}

}  // namespace

double Contour::length() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t next = (i + 1) % points.size();
    const double turn = turn_between(outward[i], outward[next]);
    sum += (points[next] - points[i]).norm() * (1.0 + turn * turn / 24.0);
  }
  return sum;
}

std::vector<Eigen::Vector2d> Contour::refined(int parts) const {
  std::vector<Eigen::Vector2d> fine;
  fine.reserve(points.size() * static_cast<std::size_t>(parts));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t next = (i + 1) % points.size();
    const double chord = (points[next] - points[i]).norm();
    const Eigen::Vector2d leave = chord * Eigen::Vector2d(-outward[i].y(), outward[i].x());
    const Eigen::Vector2d arrive = chord * Eigen::Vector2d(-outward[next].y(), outward[next].x());
    for (int k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      const double rest = 1.0 - t;
      fine.push_back(rest * rest * ((1.0 + 2.0 * t) * points[i] + t * leave) +
                     t * t * ((1.0 + 2.0 * rest) * points[next] - rest * arrive));
    }
  }
  return fine;
}

std::optional<Contour> trace_contour(BlendedSurface& surface, const Eigen::Vector2d& start,
                                     double step, double reach, double longest) {
  const auto first = correct(surface, start, 4.0 * step);
  if (!first) return std::nullopt;
  Contour contour;
  Place here = *first;
  double way = 0.0;
  while (way < longest) {
    contour.points.push_back(here.point);
    contour.outward.push_back(here.outward);
    const auto next = advance(surface, here, step);
    if (!next) return std::nullopt;
    const double length = (next->point - here.point).norm();
    way += length;
    if (surface.distance_to_data({next->point.x(), next->point.y(), 0.0}) > reach) {
      return std::nullopt;
    }
    const Eigen::Vector2d home = first->point - here.point;
    const Eigen::Vector2d along = (next->point - here.point) / length;
    const bool passes_home = home.dot(along) > 0.0 && home.dot(along) <= length &&
                             std::abs(cross(along, home)) < 0.25 * step;
    if (contour.points.size() > 8 && passes_home) return contour;
    here = *next;
  }
  return std::nullopt;
}

}  // namespace instep
