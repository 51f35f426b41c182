#include "core/geometry/ordered_spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry/point_spacing.h"
#include "core/median.h"
#include "core/stride.h"

namespace instep {
namespace {

/// How much further than the last neighbour of the point before those of a point are looked for,
/// and by how much more each time that they are too few.
constexpr double kFurther = 1.3;
constexpr double kWidening = 2.0;

/// How far the nearest of a point lie, asked of one point after the other.
class NearestInOrder {
 public:
  explicit NearestInOrder(const std::vector<Eigen::Vector3d>& points) : points_(points) {}

  /// To the last of the nearest so many, the point itself included: there are as many.
  double reach_of(std::size_t point, std::size_t count) {
    look_round(point);
    for (; squares_.size() < count; look_round(point)) looked_ *= kWidening;
    const auto last = squares_.begin() + static_cast<std::ptrdiff_t>(count - 1);
    std::nth_element(squares_.begin(), last, squares_.end());
    const double reach = std::sqrt(*last);
    looked_ = reach > 0.0 ? kFurther * reach : std::numeric_limits<double>::infinity();
    return reach;
  }

 private:
  /// Takes the squares of the distances to all within reach, and some more.
  void look_round(std::size_t point) {
    squares_.clear();
    const Eigen::Vector3d here = points_[point];
    const double most = looked_ * looked_;
    const auto take = [&](std::size_t i) {
      const Eigen::Vector3d arm = points_[i] - here;
      const double along = arm.x() * arm.x();
      const double square = along + arm.y() * arm.y() + arm.z() * arm.z();
      if (square <= most) squares_.push_back(square);
      return along <= most;
    };
    for (std::size_t i = point; i < points_.size() && take(i);) ++i;
    for (std::size_t i = point; i > 0 && take(i - 1);) --i;
  }

  const std::vector<Eigen::Vector3d>& points_;
  double looked_ = std::numeric_limits<double>::infinity();  ///< so far for the next one
  std::vector<double> squares_;
};

}  // namespace

double usual_spacing_in_order(const std::vector<Eigen::Vector3d>& points, std::size_t sample) {
  if (points.size() < 2 || sample == 0) return 0.0;
  const std::size_t count = std::min(kSpacingNeighbours + 1, points.size());
  NearestInOrder nearest(points);
  std::vector<double> spacings;
  for (std::size_t i = 0; i < points.size(); i += stride_to_at_least(sample, points.size())) {
    spacings.push_back(spacing_within(nearest.reach_of(i, count), count - 1));
  }
  return median(std::move(spacings));
}

}  // namespace instep
