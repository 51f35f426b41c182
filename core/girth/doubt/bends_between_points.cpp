#include "core/girth/doubt/bends_between_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <variant>
#include <vector>

#include "core/geometry/point_spacing.h"

namespace instep {
namespace {

// With these, intervals of scanned feet of 4,260 exact points hold in 82 % (71 without), of lasts
// of 902 bare points in 94 (92), of prisms of 14 to 24 sides of 600 and 1,500 points in 94 (67). If
// bends counted by how far points are missed, not by its square, they would be seven times all else
// that is told of simulated feet of 4,260 points, which hold without them.

/// A corner lies within so many spacings.
constexpr double kWindow = 2.0;
/// A turn within them (radians) that is not looked at: it hides next to nothing.
constexpr double kLeastTurn = 0.12;
/// Of a turn times the window: how far the others miss the points beside a corner, root mean
/// square.
constexpr double kMissedAtCorner = 0.05;

/// The points of a patch, and how far the others miss each.
class MissedPoints {
 public:
  MissedPoints(const SurfacePatch& patch, const std::vector<OrientedPoint>& points)
      : missed_(std::get<HeightPatch>(patch.field).missed()) {
    for (const std::size_t member : patch.members) places_.push_back(points[member].position);
    spacing_ = spacing_within(patch.radius, places_.size());
  }

  /// Root mean square of those within a spacing or so.
  double beside(const Eigen::Vector3d& place) const {
    double squares = 0.0;
    double weights = 0.0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double way = (places_[i] - place).squaredNorm() / (spacing_ * spacing_);
      const double weight = std::exp(-0.5 * way);
      squares += weight * missed_[i] * missed_[i];
      weights += weight;
    }
    return weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
  }

 private:
  std::vector<double> missed_;
  std::vector<Eigen::Vector3d> places_;
  double spacing_ = 0.0;
};

/// One smooth sheet over exact points.
bool is_smooth_and_exact(const SurfacePatch& patch) {
  const auto* sheet = std::get_if<HeightPatch>(&patch.field);
  return sheet != nullptr && sheet->is_exact();
}

}  // namespace

UnseenBends bends_between_points(const ContourCourse& course, const BlendedSurface& surface,
                                 double spacing) {
  UnseenBends sum;
  const Contour& contour = course.contour();
  const double window = kWindow * spacing;
  std::map<const SurfacePatch*, MissedPoints> missed;
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    const double middle = course.way_to(i) + 0.5 * contour.chord(i);
    const double turn = course.turn_over(middle - 0.5 * window, window);
    if (!(std::abs(turn) > kLeastTurn)) continue;
    const Eigen::Vector2d at = course.place_at(middle);
    const Eigen::Vector3d place(at.x(), at.y(), 0.0);
    const SurfacePatch* patch = surface.leading_patch(place);
    if (patch == nullptr || !is_smooth_and_exact(*patch)) continue;
    const auto& of_patch = missed.try_emplace(patch, *patch, surface.points()).first->second;
    const double at_corner = kMissedAtCorner * std::abs(turn) * window;
    const double likely = std::min(1.0, std::pow(of_patch.beside(place) / at_corner, 2));
    const double longer =
        likely * contour.chord(i) * longer_by_corner(std::abs(turn), kLeastTurn, kSharpestCorner);
    sum.contact_u95 += longer;
    if (turn > 0.0) sum.stretched_u95 += longer;
  }
  return sum;
}

}  // namespace instep
