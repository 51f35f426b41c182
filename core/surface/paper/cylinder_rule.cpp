#include "core/surface/paper/cylinder_rule.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace instep {
namespace {

/// Part of all points that a cylinder has to hold: one in ten.
constexpr std::size_t kPart = 10;
/// Tiles along the longer side of a view.
constexpr double kTiles = 64.0;

/// What is seen of a place when one looks along an axis.
Eigen::Vector2d seen_along(Eigen::Index axis, const Eigen::Vector3d& place) {
  return {place[(axis + 1) % 3], place[(axis + 2) % 3]};
}

/// Number of the tile in which a coordinate lies, or the nearest.
int tile_number(double coordinate, double corner, double side, int count) {
  const double tile = std::floor((coordinate - corner) / side);
  return static_cast<int>(std::clamp(tile, 0.0, static_cast<double>(count - 1)));
}

/// Squared distance from a place to the far corner of a box.
double squared_farthest(const Eigen::AlignedBox2d& box, const Eigen::Vector2d& place) {
  return (place - box.min()).cwiseAbs().cwiseMax((place - box.max()).cwiseAbs()).squaredNorm();
}

}  // namespace

CylinderRule::CylinderRule(const std::vector<Eigen::Vector3d>& points, double first_radius)
    : count_(points.size()),
      first_radius_(first_radius),
      views_{view_along(0, points), view_along(1, points), view_along(2, points)} {}

CylinderRule::View CylinderRule::view_along(Eigen::Index axis,
                                            const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox2d box;
  for (const auto& point : points) box.extend(seen_along(axis, point));
  View view;
  view.corner = box.min();
  const double longer = box.sizes().maxCoeff();
  if (longer > 0.0) view.side = longer / kTiles;
  view.counts = (box.sizes() / view.side).array().ceil().max(1.0).matrix().cast<int>();
  view.tiles.resize(static_cast<std::size_t>(view.counts.x()) *
                    static_cast<std::size_t>(view.counts.y()));
  for (const auto& point : points) {
    const Eigen::Vector2d seen = seen_along(axis, point);
    const int column = tile_number(seen.x(), view.corner.x(), view.side, view.counts.x());
    const int row = tile_number(seen.y(), view.corner.y(), view.side, view.counts.y());
    Tile& tile = view.tiles[static_cast<std::size_t>(row * view.counts.x() + column)];
    tile.points.push_back(point);
    tile.range.include(point[axis]);
  }
  return view;
}

CylinderRule::Content CylinderRule::content(const View& view, Eigen::Index axis,
                                            const Eigen::Vector2d& centre, double radius) {
  const auto column = [&](double x) {
    return tile_number(x, view.corner.x(), view.side, view.counts.x());
  };
  const auto row = [&](double y) {
    return tile_number(y, view.corner.y(), view.side, view.counts.y());
  };
  const double squared = radius * radius;
  Content content;
  for (int y = row(centre.y() - radius); y <= row(centre.y() + radius); ++y) {
    for (int x = column(centre.x() - radius); x <= column(centre.x() + radius); ++x) {
      const Tile& tile = view.tiles[static_cast<std::size_t>(y * view.counts.x() + x)];
      if (tile.points.empty()) continue;
      const Eigen::Vector2d corner = view.corner + view.side * Eigen::Vector2d(x, y);
      if (squared_farthest({corner, corner.array() + view.side}, centre) <= squared) {
        content.points += tile.points.size();
        content.range.include(tile.range);
        continue;
      }
      for (const auto& point : tile.points) {
        if ((seen_along(axis, point) - centre).squaredNorm() > squared) continue;
        ++content.points;
        content.range.include(point[axis]);
      }
    }
  }
  return content;
}

Extent CylinderRule::range(Eigen::Index axis, const Eigen::Vector3d& place) const {
  const View& view = views_[static_cast<std::size_t>(axis)];
  const Eigen::Vector2d centre = seen_along(axis, place);
  for (double radius = first_radius_;; radius *= 2.0) {
    const Content inside = content(view, axis, centre, radius);
    if (kPart * inside.points >= count_) return inside.range;
  }
}

}  // namespace instep
