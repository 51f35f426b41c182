#include "core/surface/heights/quadratic_sheet.h"

namespace instep {

QuadraticSheet::QuadraticSheet(const std::vector<OrientedPoint>& points,
                               const Eigen::Vector3d& outward, const Eigen::Vector3d& centre,
                               double radius)
    : base_(axes_over(outward), centre, radius),
      terms_(least_squares(samples_over(points, base_))) {}

FieldValue QuadraticSheet::at(const Eigen::Vector3d& position) const {
  const auto spot = base_.see(position);
  const double x = spot.place.x();
  const double y = spot.place.y();
  const Eigen::Vector2d slope(terms_[1] + 2.0 * x * terms_[3] + y * terms_[4],
                              terms_[2] + x * terms_[4] + 2.0 * y * terms_[5]);
  return {base_.radius() * (spot.height - height_of(terms_, spot.place)),
          base_.gradient(slope, spot)};
}

}  // namespace instep
