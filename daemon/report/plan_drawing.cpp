#include "daemon/report/plan_drawing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "core/geometry/polygon.h"
#include "daemon/report/length_drawing.h"
#include "daemon/report/svg_text.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kMostPoints = 5000;
constexpr double kPointRadiusMm = 0.4;
constexpr double kLengthLineBelowPx = 22.0;
constexpr double kLengthBelowLinePx = 17.0;

/// What is drawn of the foot: all below the ankle.
constexpr double kHighestMm = 90.0;

class View {
 public:
  View(const Eigen::AlignedBox2d& foot, const Vector2d& corner, const Vector2d& size)
      : foot_(foot), corner_(corner) {
    const Vector2d extent = foot.isEmpty() ? Vector2d(1.0, 1.0) : Vector2d(foot.sizes());
    scale_ = std::min(size.x() / std::max(1.0, extent.x()), size.y() / std::max(1.0, extent.y()));
  }

  /// x to the right, y upwards on the page: the foot is seen from above.
  Vector2d operator()(const Vector3d& point) const {
    return corner_ + scale_ * Vector2d(point.x() - foot_.min().x(), foot_.max().y() - point.y());
  }

  double px_per_mm() const { return scale_; }
  double bottom() const {
    return corner_.y() + (foot_.isEmpty() ? 0.0 : scale_ * foot_.sizes().y());
  }

 private:
  Eigen::AlignedBox2d foot_;
  Vector2d corner_;
  double scale_ = 1.0;
};

std::vector<Vector3d> low_points(const FootScan& foot) {
  std::vector<Vector3d> points;
  for (const auto& point : foot.cloud.positions) {
    if (point.z() < kHighestMm && point.allFinite()) points.push_back(point);
  }
  return points;
}

std::string tapes(const MeasureSet& measures, const View& view) {
  std::string elements;
  std::string names;  // over all tapes
  for (const auto& measure : measures.measures) {
    if (!measure.girth || !measure.plane) continue;
    std::vector<Vector2d> ring;
    for (const auto& corner : measure.girth->contour) {
      if (corner.allFinite()) ring.push_back(view(measure.plane->lift(corner)));
    }
    if (ring.size() < 3) continue;
    const auto outline = convex_hull(ring);
    elements += svg::polygon(outline, "tape");
    const auto end = std::max_element(outline.begin(), outline.end(),
                                      [](const auto& a, const auto& b) { return a.y() < b.y(); });
    const std::string name = measure.id.substr(0, measure.id.find('_'));
    names += svg::label(*end + Vector2d(0.0, 15.0), "name", name);
  }
  return elements + names;
}

std::string length_line(const FootScan& foot, const MeasureSet& measures, const View& view,
                        double y) {
  const auto length = draw_length(foot, measures);
  if (!length) return {};
  const Vector2d from(view(length->rear).x(), y);
  const Vector2d to(view(length->front).x(), from.y());
  return svg::measuring_line(from, to, 5.0, "rule") +
         svg::label((from + to) / 2.0 + Vector2d(0.0, kLengthBelowLinePx), "length",
                    length->interval + " mm");
}

std::string ball_line(const FootScan& foot, const View& view) {
  std::string elements;
  for (const char* name : {"metatarsale_tibiale", "metatarsale_fibulare", "toe2_tip", "pternion"}) {
    const auto found = foot.landmarks.find(name);
    if (found == foot.landmarks.end() || !found->second.position_mm.allFinite()) continue;
    elements += svg::dots({view(found->second.position_mm)}, 3.5, "mark");
  }
  return elements;
}

}  // namespace

svg::Block plan_drawing(const FootScan& foot, const MeasureSet& measures, const Vector2d& corner,
                        const Vector2d& size) {
  const auto points = low_points(foot);
  Eigen::AlignedBox2d box;
  for (const auto& point : points) box.extend(Vector2d(point.head<2>()));
  const View view(box, corner, size);
  std::vector<Vector2d> drawn;
  const std::size_t step = points.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < points.size(); i += step) drawn.push_back(view(points[i]));
  const double length_y = view.bottom() + kLengthLineBelowPx;
  return {svg::dots(drawn, kPointRadiusMm * view.px_per_mm(), "cloud") + tapes(measures, view) +
              ball_line(foot, view) + length_line(foot, measures, view, length_y),
          length_y + kLengthBelowLinePx};
}

}  // namespace instep
