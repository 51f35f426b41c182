#include "daemon/report/section_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/polygon.h"
#include "daemon/report/svg_text.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBandMm = 1.5;
constexpr double kMarginMm = 8.0;
constexpr std::size_t kMostPoints = 700;

/// Where a point of the foot frame comes to lie on the drawing, before it is set on its base line.
class View {
 public:
  View(const TapePlane& plane, double medial_sign) {
    const Vector3d upwards = Vector3d::UnitZ() - plane.normal().z() * plane.normal();
    // A level tape has no upward side: heel to toe then takes its place.
    is_level_ = upwards.norm() <= 0.2;
    up_ = !is_level_
              ? Vector3d(upwards.normalized())
              : Vector3d((Vector3d::UnitX() - plane.normal().x() * plane.normal()).normalized());
    right_ = up_.cross(plane.normal());
    if (right_.y() * medial_sign > 0.0) right_ = -right_;
  }

  bool is_level() const { return is_level_; }
  /// A tape round heel and instep leans to the front by half a right angle, others by little.
  bool leans_to_front() const { return !is_level_ && up_.x() > 0.5; }

  Vector2d operator()(const Vector3d& point) const { return {right_.dot(point), -up_.dot(point)}; }

 private:
  bool is_level_ = false;
  Vector3d up_;
  Vector3d right_;  ///< towards lateral
};

void thin(std::vector<Vector2d>& points) {
  if (points.size() <= kMostPoints) return;
  std::vector<Vector2d> kept;
  for (std::size_t i = 0; i < kMostPoints; ++i) {
    kept.push_back(points[i * points.size() / kMostPoints]);
  }
  points = std::move(kept);
}

bool is_near(const Vector2d& point, const SectionDrawing& drawing) {
  return point.x() > drawing.left - kMarginMm && point.x() < drawing.right + kMarginMm &&
         point.y() < kMarginMm && point.y() > -drawing.height - kMarginMm;
}

}  // namespace

SectionDrawing draw_section(const FootScan& foot, const Measure& measure) {
  SectionDrawing drawing;
  const TapePlane& plane = *measure.plane;
  const View view(plane, foot.medial_sign());
  for (const auto& corner : measure.girth->contour) {
    if (corner.allFinite()) drawing.contour.push_back(view(plane.lift(corner)));
  }
  if (drawing.contour.empty()) return drawing;
  drawing.is_level = view.is_level();
  if (view.is_level()) drawing.upper_end = "front";
  if (view.leans_to_front()) drawing.upper_end = "instep";
  if (view.is_level() || view.leans_to_front()) drawing.lower_end = "heel";

  const auto lower = [](const Vector2d& a, const Vector2d& b) { return a.y() < b.y(); };
  const auto [top, bottom] =
      std::minmax_element(drawing.contour.begin(), drawing.contour.end(), lower);
  const Vector2d base(0.0, bottom->y());
  drawing.height = bottom->y() - top->y();
  for (auto& corner : drawing.contour) corner -= base;
  drawing.tape = convex_hull(drawing.contour);
  drawing.left = drawing.tape.front().x();
  drawing.right = drawing.left;
  for (const auto& corner : drawing.tape) drawing.right = std::max(drawing.right, corner.x());

  for (std::size_t i = 0; i < foot.cloud.size(); ++i) {
    const Vector3d& point = foot.cloud.positions[i];
    if (!(std::abs(plane.distance(point)) < kBandMm)) continue;
    const Vector2d place = view(point) - base;
    if (!is_near(place, drawing)) continue;
    (foot.cloud.was_seen(i) ? drawing.seen_points : drawing.platform_points).push_back(place);
  }
  thin(drawing.seen_points);
  thin(drawing.platform_points);
  return drawing;
}

std::string section_svg(const SectionDrawing& drawing, const Vector2d& origin, double per_mm,
                        const SectionStyle& style) {
  const auto placed = [&](const std::vector<Vector2d>& points) {
    return svg::placed(points, origin, per_mm);
  };
  return svg::polygon(svg::thinned(placed(drawing.tape), style.outline_step), style.tape) +
         svg::polygon(svg::thinned(placed(drawing.contour), style.outline_step), "skin") +
         svg::dots(placed(drawing.platform_points), style.point_radius, "platform") +
         svg::dots(placed(drawing.seen_points), style.point_radius, "seen");
}

std::vector<DrawnSection> draw_sections(const FootScan& foot, const MeasureSet& measures) {
  std::vector<DrawnSection> sections;
  for (const auto& measure : measures.measures) {
    if (!measure.girth || !measure.plane) continue;
    DrawnSection section{&measure, draw_section(foot, measure)};
    if (section.drawing.contour.size() >= 3) sections.push_back(std::move(section));
  }
  return sections;
}

}  // namespace instep
