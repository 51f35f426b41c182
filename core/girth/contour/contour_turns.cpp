#include "core/girth/contour/contour_turns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

#include "core/geometry/plane_vectors.h"
#include "core/geometry/polygon.h"

namespace instep {
namespace {

/// Stands for none where it is divided by.
constexpr double kLeastFolds = 1e-3;

std::vector<double> turns_of_line(const Contour& contour) {
  const std::size_t count = contour.points.size();
  std::vector<double> turns(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    turns[i] += 0.5 * contour.turn(i);
    turns[contour.next(i)] += 0.5 * contour.turn(i);
  }
  return turns;
}

std::vector<double> turns_of_tape(const Contour& contour) {
  const auto hull = convex_hull(contour.points);
  std::map<std::pair<double, double>, double> turn_at;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d before = hull[i] - hull[(i + hull.size() - 1) % hull.size()];
    const Eigen::Vector2d after = hull[(i + 1) % hull.size()] - hull[i];
    turn_at[{hull[i].x(), hull[i].y()}] = turn_between(before, after);
  }
  std::vector<double> turns;
  turns.reserve(contour.points.size());
  for (const auto& point : contour.points) {
    const auto found = turn_at.find({point.x(), point.y()});
    turns.push_back(found == turn_at.end() ? 0.0 : found->second);
  }
  return turns;
}

}  // namespace

ContourTurns turns_of(const Contour& contour) {
  return {turns_of_line(contour), turns_of_tape(contour)};
}

double mean_fold_depth(const Contour& contour, double more) {
  double turned = 0.0;
  for (std::size_t i = 0; i < contour.outward.size(); ++i) turned += std::abs(contour.turn(i));
  const double folds = std::max(0.5 * turned / std::numbers::pi - 1.0, kLeastFolds);
  return 0.5 * more / folds;
}

}  // namespace instep
