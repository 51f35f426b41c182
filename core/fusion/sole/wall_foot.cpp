#include "core/fusion/sole/wall_foot.h"

#include <algorithm>
#include <cmath>

#include "core/fusion/sole/free_skin.h"
#include "core/fusion/sole/wall_end.h"
#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kLeastInsetMm = 3.0;
constexpr double kMostInsetShare = 0.65;  // of the way across; beside an arch stands about a third
constexpr double kMostSine = 0.95;
constexpr double kMostOutwardMm = 2.0;   // a wall lost above its widest place may bulge so far
constexpr double kLeaningSine = 0.45;    // of a wall that leans in as much as a sole's edge does
constexpr double kArchOverEdgeMm = 4.0;  // what leans in so far over the edge stands beside an arch

/// Of the dip of a wall that bends evenly, at a height.
double sine_at(double end_height, double sine_of_end, double bend, double height) {
  return std::min(kMostSine, sine_of_end + bend * (end_height - height));
}

/// The wall from its seen end on, in its own bend, down to the height where the round edge of the
/// sole begins, or to where it leans in as much as that does; the end alone where it was seen so
/// far. Inward distance and height.
std::vector<Vector2d> wall_to_edge(double height, double sine, double bend, double edge_height) {
  constexpr int kPieces = 8;
  std::vector<Vector2d> corners{{0.0, height}};
  if (bend > 0.0) edge_height = std::max(edge_height, height - (kLeaningSine - sine) / bend);
  if (height <= edge_height || sine >= kLeaningSine) return corners;
  for (int i = 1; i <= kPieces; ++i) {
    const double at = std::lerp(height, edge_height, static_cast<double>(i) / kPieces);
    const double chord = (std::asin(sine) + std::asin(sine_at(height, sine, bend, at))) / 2.0;
    corners.emplace_back(std::max(-kMostOutwardMm, (height - at) * std::tan(chord)), at);
  }
  return corners;
}

/// Skin pressed on the platform hangs in an arc above its edge; that beside an arch, which ends
/// higher, comes down in a slope.
double falloff_beside_arch(double height, double edge_height) {
  return std::clamp((height - edge_height) / kArchOverEdgeMm, 0.0, 1.0);
}

/// A taut tape from the wall's end, along the arc on which it bends, and on to the contact.
std::vector<Vector2d> taut_over_arch(double height, double dip, double radius, double contact) {
  constexpr int kPieces = 12;
  const Vector2d begin(0.0, height);
  std::vector<Vector2d> corners{begin};
  if (contact <= 0.0) return {begin, {0.0, 0.0}};
  const Vector2d centre = begin + radius * Vector2d(std::cos(dip), std::sin(dip));
  const Vector2d to_contact = Vector2d(contact, 0.0) - centre;
  if (to_contact.norm() > radius) {
    // The arc ends where its tangent points at the contact.
    const double below = std::atan2(-to_contact.y(), -to_contact.x());
    const double end = below - std::acos(radius / to_contact.norm());
    for (int i = 1; i <= kPieces; ++i) {
      const double at = std::lerp(dip, std::max(dip, end), static_cast<double>(i) / kPieces);
      corners.emplace_back(centre - radius * Vector2d(std::cos(at), std::sin(at)));
    }
  }
  corners.emplace_back(contact, 0.0);
  return corners;
}

/// How far a convex outline goes on from a place in a direction.
double reach_across(const std::vector<Vector2d>& outline, const Vector2d& place,
                    const Vector2d& direction) {
  double reach = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d edge = outline[(i + 1) % outline.size()] - a;
    const double turn = edge.x() * direction.y() - edge.y() * direction.x();
    if (std::abs(turn) < 1e-12) continue;
    const Vector2d from = place - a;
    const double along = (edge.x() * from.y() - edge.y() * from.x()) / -turn;
    const double on_edge = (direction.x() * from.y() - direction.y() * from.x()) / -turn;
    if (on_edge >= 0.0 && on_edge <= 1.0) reach = std::max(reach, along);
  }
  return reach;
}

/// How the skin leaves a wall's end.
struct Ending {
  double sine_of_dip = 0.0;
  double bend = 0.0;
};

/// Of an end and those beside it: one alone tells it badly. The dip of another is carried to this
/// one's height in its own bend.
Ending usual_ending(const std::vector<WallEnd>& ends, const WallEnd& here) {
  constexpr double kAlongMm = 10.0;
  constexpr double kSameFacing = 0.8;
  double weights = 0.0;
  Ending usual;
  for (const auto& end : ends) {
    if (end.normal.dot(here.normal) < kSameFacing) continue;
    const double apart = (end.position - here.position).squaredNorm() / (kAlongMm * kAlongMm);
    const double weight = std::exp(-0.5 * apart);
    const double drop = end.position.z() - here.position.z();
    weights += weight;
    usual.sine_of_dip += weight * (end.bend * drop - end.normal.z());
    usual.bend += weight * end.bend;
  }
  return {usual.sine_of_dip / weights, std::max(0.0, usual.bend / weights)};
}

std::vector<Vector2d> shadow_of(const PointCloud& foot, double most_z) {
  std::vector<Vector2d> shadow;
  for (const auto& point : foot.positions) {
    if (point.z() < most_z) shadow.push_back(point.head<2>());
  }
  return convex_hull(std::move(shadow));
}

}  // namespace

WallFoot::WallFoot(const Vector2d& place, const Vector2d& out, const WallShape& shape,
                   const WallSettings& settings)
    : place_(place), out_(out) {
  const double height = std::max(0.0, shape.height);
  const double end_sine = std::clamp(shape.sine_of_dip, -kMostSine, kMostSine);
  course_ = wall_to_edge(height, end_sine, shape.bend, settings.usual_edge_mm);
  wall_corners_ = course_.size();
  const Vector2d begin = course_.back();
  const double sine = sine_at(height, end_sine, shape.bend, begin.y());
  const double turn = std::acos(std::max(kLeaningSine, sine));
  const double falloff = std::max(falloff_of_bend(turn, shape.bend * begin.y()),
                                  falloff_beside_arch(begin.y(), settings.usual_edge_mm));
  for (const auto& corner : free_skin(turn, falloff, begin.y())) {
    course_.emplace_back(begin.x() + corner.x(), corner.y());
  }
  if (contact() > shape.most_inset_mm) {
    const double from = std::max(0.0, end_sine);
    // No tighter than the arc that just touches the platform.
    const double radius = 1.0 / std::max(shape.bend, (1.0 - from) / std::max(height, 1e-9));
    course_ = taut_over_arch(height, std::asin(from), radius, shape.most_inset_mm);
    wall_corners_ = 1;
  }
  if (contact() < kLeastInsetMm) course_.emplace_back(kLeastInsetMm, 0.0);
}

std::vector<WallFoot::Place> WallFoot::hidden_wall(double spacing) const {
  std::vector<Place> places;
  double next = spacing;  // from the corner before
  for (std::size_t i = 1; i < wall_corners_; ++i) {
    const Vector2d piece = course_[i] - course_[i - 1];
    const double length = piece.norm();
    for (; next <= length; next += spacing) {
      const Vector2d at = course_[i - 1] + next / length * piece;
      places.push_back({at.x(), at.y(), piece.x() / length});
    }
    next -= length;
  }
  return places;
}

double WallFoot::skin_height(double inward) const {
  const auto after =
      std::upper_bound(course_.begin(), course_.end(), inward,
                       [](double at, const Vector2d& corner) { return at < corner.x(); });
  if (after == course_.end()) return 0.0;
  if (after == course_.begin()) return course_.front().y();
  const Vector2d& before = *(after - 1);
  const double share = (inward - before.x()) / (after->x() - before.x());
  return std::max(0.0, std::lerp(before.y(), after->y(), share));
}

std::vector<WallFoot> find_wall_feet(const PointCloud& foot, double standing_height_mm) {
  const double most_z = standing_height_mm + kHighestWallEndMm;
  const auto ends = find_wall_ends(foot, most_z, kWallBendReachMm);
  const auto shadow = shadow_of(foot, most_z);
  std::vector<WallFoot> feet;
  for (const auto& end : ends) {
    const double level = end.normal.head<2>().norm();
    if (!(level > std::sqrt(1.0 - kMostSine * kMostSine))) continue;
    const Vector2d out = end.normal.head<2>() / level;
    const Vector2d place = end.position.head<2>();
    const Ending usual = usual_ending(ends, end);
    feet.emplace_back(place, out,
                      WallShape{end.position.z() - standing_height_mm, usual.sine_of_dip,
                                usual.bend, kMostInsetShare * reach_across(shadow, place, -out)});
  }
  return feet;
}

}  // namespace instep
