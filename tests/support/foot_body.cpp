#include "tests/support/foot_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace instep::test {
namespace {

constexpr double kCutMm = 90.0;
constexpr double kWidestHeightMm = 12.0;  ///< of the borders over the floor

double bump(double t, double at, double width) {
  return std::exp(-std::pow((t - at) / width, 2));
}

/// Rounds off the ends: 0 at both, 1 between; the front by its own power.
double cap(double t, double front_power) {
  const double power = t < 0.5 ? 5.0 : front_power;
  return std::sqrt(std::max(0.0, 1.0 - std::pow(std::abs(2.0 * t - 1.0), power)));
}

double smooth_step(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

}  // namespace

double FootBody::medial_border(double x) const {
  const double t = x / length_mm;
  return length_mm * cap(t, 9.0) *
         (0.125 + 0.045 * bump(t, 0.70, 0.10) - 0.035 * bump(t, 0.42, 0.10));
}

double FootBody::lateral_border(double x) const {
  const double t = x / length_mm;
  return length_mm * cap(t, 4.0) * (0.125 + 0.07 * bump(t, 0.62, 0.12));
}

double FootBody::height(double x) const {
  const double t = x / length_mm;
  const double full = length_mm * (0.09 + 0.32 * (1.0 - smooth_step((t - 0.15) / 0.65)));
  return kWidestHeightMm + (full - kWidestHeightMm) * cap(t, 7.0);
}

PointCloud FootBody::points() const {
  PointCloud cloud;
  const auto rings = static_cast<int>(1.4 * length_mm / spacing_mm);
  for (int ring = 1; ring < rings; ++ring) {
    const double x = length_mm * 0.5 * (1.0 - std::cos(std::numbers::pi * ring / rings));
    const double medial = medial_border(x);
    const double lateral = lateral_border(x);
    const double rise = height(x) - kWidestHeightMm;
    const double fall = kWidestHeightMm * cap(x / length_mm, 7.0);
    const auto count = static_cast<int>(2.0 * (medial + lateral + rise) / spacing_mm) + 8;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / count;
      const double side = std::cos(angle);
      const double up = std::sin(angle);
      const double z =
          kWidestHeightMm + (up > 0.0 ? rise * std::pow(up, 0.9) : -fall * std::pow(-up, 0.5));
      if (z <= kCutMm) cloud.positions.emplace_back(x, side * (side > 0 ? medial : lateral), z);
    }
  }
  return cloud;
}

PointCloud mirrored(PointCloud cloud) {
  for (auto* list : {&cloud.positions, &cloud.normals, &cloud.view_directions}) {
    for (auto& vector : *list) vector.y() = -vector.y();
  }
  return cloud;
}

PointCloud half_of(const PointCloud& cloud, std::size_t first) {
  std::vector<std::size_t> indices;
  for (std::size_t i = first; i < cloud.size(); i += 2) indices.push_back(i);
  return cloud.subset(indices);
}

}  // namespace instep::test
