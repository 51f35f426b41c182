#include "core/girth/contour/contour_trace.h"

#include <cmath>
#include <numbers>

#include "core/geometry/plane_vectors.h"

namespace instep {
namespace {

constexpr int kMostCorrections = 12;
/// A last move of Newton that is shorter, in steps, leaves an error of its square.
constexpr double kLastMove = 1e-3;
/// A step that turns further is halved, down to this part of the full step.
constexpr double kLargestTurn = 0.2;
constexpr double kShortestStep = 1.0 / 64.0;
/// A line that turns less at a step is likely to go on like that.
constexpr double kSmoothTurn = 0.05;
/// At a crease the line is looked for round the last point, from outside inwards, in steps of the
/// angle.
constexpr double kCreaseStep = 1.0 / 64.0;
constexpr int kCreaseAngles = 48;
constexpr double kFirstCreaseAngle = 0.05;
constexpr double kSharpestCrease = 2.8;
/// Most corners of a line; one that has more is no section but noise.
constexpr int kMostCorners = 64;
/// A line that is closed has more corners, and comes back within this part of a step.
constexpr std::size_t kFewestCorners = 8;
constexpr double kBesideHome = 0.25;
/// Most steps against those that the longest line would take at full length.
constexpr double kMostSteps = 2.0;
/// Least slope within the plane: below it the surface runs along the plane.
constexpr double kLeastSlope = 0.05;

struct Place {
  Eigen::Vector2d point;
  Eigen::Vector2d outward;  ///< unit length
};

/// Tells when a line of steps is back where it began.
class WayHome {
 public:
  enum class Step { kElsewhere, kPastIt, kFromIt };

  /// `beside`: so near the line passes it.
  WayHome(const Eigen::Vector2d& home, double beside) : home_(home), beside_(beside) {}

  /// Of the steps one after the other. Home may lie in a bend, past the end of one step and before
  /// the beginning of the next: the latter leads from it.
  Step of_step(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const double length = (to - from).norm();
    const Eigen::Vector2d along = (to - from) / length;
    const Eigen::Vector2d arm = home_ - from;
    const double ahead = along.dot(arm);
    const bool in_bend = was_ahead_ && ahead <= 0.0 && arm.norm() < beside_;
    was_ahead_ = ahead > length;
    if (in_bend) return Step::kFromIt;
    const bool past = ahead > 0.0 && !was_ahead_ && std::abs(cross(along, arm)) < beside_;
    return past ? Step::kPastIt : Step::kElsewhere;
  }

 private:
  Eigen::Vector2d home_;
  double beside_;
  bool was_ahead_ = false;
};

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

/// One step onwards, as long as the bend allows. `bend`: by how much the line turned for each unit
/// of its length so far.
std::optional<Place> advance(BlendedSurface& surface, const Place& from, double bend, double step) {
  const Eigen::Vector2d along(-from.outward.y(), from.outward.x());
  for (double length = step; length >= kShortestStep * step; length *= 0.5) {
    const bool shortest = length < 2.0 * kShortestStep * step;
    // The chord of an arc runs half way between its ends.
    const double half = 0.5 * bend * length;
    const Eigen::Vector2d ahead = length * (std::cos(half) * along - std::sin(half) * from.outward);
    const auto next = correct(surface, from.point + ahead, 0.7 * length);
    if (!next) continue;
    const double turn = std::abs(turn_between(from.outward, next->outward));
    if (turn <= kLargestTurn || (shortest && turn < 1.5)) return next;
  }
  return std::nullopt;
}

/// One very short step round a corner of the line: on a small circle round it, the place where the
/// field first changes from outside to inside, coming from the direction that points outwards.
std::optional<Place> turn_corner(BlendedSurface& surface, const Place& from, double radius) {
  const Eigen::Vector2d along(-from.outward.y(), from.outward.x());
  const auto on_circle = [&](double angle) -> Eigen::Vector2d {
    return from.point + radius * (std::cos(angle) * from.outward + std::sin(angle) * along);
  };
  const auto value_at = [&](double angle) {
    const Eigen::Vector2d point = on_circle(angle);
    const auto field = surface.at({point.x(), point.y(), 0.0});
    return field ? field->value : 1.0;
  };
  const double step = 2.0 * kSharpestCrease / kCreaseAngles;
  double outside = kFirstCreaseAngle;
  // Where the body is hollow by a right angle or more, the line goes on that way, or short of it.
  while (!(value_at(outside) > 0.0)) {
    outside -= step;
    if (outside < -0.5 * std::numbers::pi) return std::nullopt;
  }
  double inside = outside;
  while (inside < 0.5 * std::numbers::pi + kSharpestCrease && value_at(inside) > 0.0) {
    outside = inside;
    inside += step;
  }
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (outside + inside);
    (value_at(middle) > 0.0 ? outside : inside) = middle;
  }
  const Eigen::Vector2d point = on_circle(inside);
  const auto field = surface.at({point.x(), point.y(), 0.0});
  if (!field || !(field->gradient.head<2>().norm() > kLeastSlope)) return std::nullopt;
  return Place{point, field->gradient.head<2>().normalized()};
}

/// As far as a line was followed.
struct FollowedLine {
  Contour contour;
  bool is_closed = false;
};

/// From a place on it, counter-clockwise round the body.
FollowedLine follow(BlendedSurface& surface, const Place& first, double step, double reach,
                    double longest) {
  FollowedLine line;
  Contour& contour = line.contour;
  Place here = first;
  double way = 0.0;
  double bend = 0.0;
  WayHome way_home(first.point, kBesideHome * step);
  double leeway = 0.0;  // so far the line may go before it can be too far from all points
  int corners = 0;
  const auto most = static_cast<std::size_t>(kMostSteps * longest / step);
  while (way < longest && contour.points.size() < most) {
    contour.points.push_back(here.point);
    contour.outward.push_back(here.outward);
    const std::size_t patches = surface.patches();
    auto next = advance(surface, here, bend, step);
    if (!next && surface.patches() > patches) {
      // A new patch has moved the line from under the last point.
      const auto moved = correct(surface, here.point, step);
      if (moved) next = advance(surface, *moved, bend, step);
    }
    if (!next && ++corners <= kMostCorners) {
      next = turn_corner(surface, here, kCreaseStep * step);
    }
    if (!next) return line;
    const double length = (next->point - here.point).norm();
    const double turn = turn_between(here.outward, next->outward);
    bend = std::abs(turn) < kSmoothTurn ? turn / length : 0.0;
    way += length;
    leeway -= length;
    if (leeway < 0.0) {
      leeway = reach - surface.distance_to_data({next->point.x(), next->point.y(), 0.0});
      if (leeway < 0.0) return line;
    }
    const auto home = way_home.of_step(here.point, next->point);
    if (contour.points.size() > kFewestCorners && home != WayHome::Step::kElsewhere) {
      if (home == WayHome::Step::kFromIt) {
        contour.points.pop_back();
        contour.outward.pop_back();
      }
      line.is_closed = true;
      return line;
    }
    here = *next;
  }
  return line;
}

}  // namespace

std::optional<Contour> trace_contour(BlendedSurface& surface, const Eigen::Vector2d& start,
                                     double step, double reach, double longest) {
  const auto first = correct(surface, start, 4.0 * step);
  if (!first) return std::nullopt;
  auto line = follow(surface, *first, step, reach, longest);
  if (!line.is_closed) return std::nullopt;
  return std::move(line.contour);
}

std::optional<Contour> trace_open_line(BlendedSurface& surface, const Eigen::Vector2d& start,
                                       double step, double reach, double longest) {
  const auto first = correct(surface, start, 4.0 * step);
  if (!first) return std::nullopt;
  auto line = follow(surface, *first, step, reach, longest);
  if (line.is_closed || line.contour.points.size() < kFewestCorners) return std::nullopt;
  return std::move(line.contour);
}

}  // namespace instep
