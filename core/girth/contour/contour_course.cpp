#include "core/girth/contour/contour_course.h"

#include <algorithm>
#include <cmath>

namespace instep {

ContourCourse::ContourCourse(const Contour& contour) : contour_(contour) {
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    ways_.push_back(ways_.back() + contour.chord(i));
    turns_.push_back(turns_.back() + contour.turn(i));
  }
}

ContourCourse::Station ContourCourse::station_at(double way) const {
  const auto after = std::upper_bound(ways_.begin(), ways_.end() - 1, way);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - ways_.begin(), 1));
  const double step = ways_[i] - ways_[i - 1];
  return {i - 1, step > 0.0 ? (way - ways_[i - 1]) / step : 0.0};
}

double ContourCourse::turn_at(double way) const {
  const auto [corner, part] = station_at(way);
  return turns_[corner] + part * (turns_[corner + 1] - turns_[corner]);
}

double ContourCourse::turn_over(double begin, double way) const {
  const auto turned = [this](double to) {
    const double rounds = std::floor(to / length());
    return rounds * turns_.back() + turn_at(to - rounds * length());
  };
  return turned(begin + way) - turned(begin);
}

Eigen::Vector2d ContourCourse::place_at(double way) const {
  const auto [corner, part] = station_at(way - length() * std::floor(way / length()));
  const auto& points = contour_.points;
  return (1.0 - part) * points[corner] + part * points[contour_.next(corner)];
}

}  // namespace instep
