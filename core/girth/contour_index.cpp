#include "core/girth/contour_index.h"

#include <algorithm>

namespace instep {
namespace {

std::vector<Eigen::Vector3d> on_the_plane(const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector3d> places;
  places.reserve(points.size());
  for (const auto& point : points) places.emplace_back(point.x(), point.y(), 0.0);
  return places;
}

}  // namespace

ContourIndex::ContourIndex(const Contour& contour)
    : corners_(on_the_plane(contour.points)), ways_{0.0} {
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    const auto& next = contour.points[(i + 1) % contour.points.size()];
    ways_.push_back(ways_.back() + (next - contour.points[i]).norm());
  }
}

ContourIndex::Foot ContourIndex::foot_of(const Eigen::Vector2d& point) const {
  const auto& corners = corners_.points();
  const std::size_t count = corners.size();
  const std::size_t nearest = corners_.nearest({point.x(), point.y(), 0.0}, 1).front().index;
  Foot best{(corners[nearest].head<2>() - point).norm(), ways_[nearest]};
  for (const std::size_t from : {(nearest + count - 1) % count, nearest}) {
    const double length = ways_[from + 1] - ways_[from];
    if (!(length > 0.0)) continue;
    const Eigen::Vector2d start = corners[from].head<2>();
    const Eigen::Vector2d along = (corners[(from + 1) % count].head<2>() - start) / length;
    const double part = std::clamp(along.dot(point - start), 0.0, length);
    const double distance = (start + part * along - point).norm();
    if (distance < best.distance) best = {distance, ways_[from] + part};
  }
  return best;
}

}  // namespace instep
