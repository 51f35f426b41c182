#include "sim/outline_probe.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kFarMm = 600.0;

/// Halves a bracket whose `inside` has a negative value.
double bisected(const std::function<double(double)>& value, double inside, double outside) {
  while (std::abs(outside - inside) > 1e-6) {
    const double middle = 0.5 * (inside + outside);
    (value(middle) < 0.0 ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

}  // namespace

double place_of_maximum(const std::function<double(double)>& function, double low, double high,
                        double step) {
  const int steps = std::max(1, static_cast<int>(std::ceil((high - low) / step)));
  const double stride = (high - low) / steps;
  double best = low;
  double best_value = function(low);
  for (int i = 1; i <= steps; ++i) {
    const double value = function(low + i * stride);
    if (value > best_value) {
      best_value = value;
      best = low + i * stride;
    }
  }
  const double golden = 1.0 / std::numbers::phi;
  double left = std::max(low, best - stride);
  double right = std::min(high, best + stride);
  double first = right - golden * (right - left), second = left + golden * (right - left);
  double at_first = function(first), at_second = function(second);
  while (right - left > 1e-4) {
    if (at_first < at_second) {
      left = std::exchange(first, second);
      at_first = at_second;
      second = left + golden * (right - left);
      at_second = function(second);
    } else {
      right = std::exchange(second, first);
      at_second = at_first;
      first = right - golden * (right - left);
      at_first = function(first);
    }
  }
  const double refined = 0.5 * (left + right);
  return function(refined) >= best_value ? refined : best;
}

double OutlineProbe::reach(const Vector3d& centre, const Vector3d& direction) const {
  const auto at = [&](double distance) { return value(centre + distance * direction); };
  double distance = kFarMm;
  while (distance > -kFarMm) {
    const double free = at(distance);
    if (free < 1e-4) return bisected(at, distance - 1e-3, distance + 1e-3);
    distance -= std::max(0.7 * free, 1e-4);
  }
  return -kFarMm;
}

Vector3d OutlineProbe::outermost(const Vector3d& centre, const Vector3d& direction) const {
  const auto reach_at = [&](double z) { return reach({centre.x(), centre.y(), z}, direction); };
  const double z = place_of_maximum(reach_at, 0.0, outline_height_mm_, 1.0);
  return Vector3d(centre.x(), centre.y(), z) + reach_at(z) * direction;
}

Vector3d OutlineProbe::side(double station, double sign) const {
  return outermost({station, 0.0, 0.0}, sign * Vector3d::UnitY());
}

Vector3d OutlineProbe::end(double offset, double sign) const {
  return outermost({0.0, offset, 0.0}, sign * Vector3d::UnitX());
}

Vector3d OutlineProbe::profile(const Vector3d& centre, const Vector3d& direction,
                               double half_width) const {
  const auto reach_at = [&](double y) { return reach({centre.x(), y, centre.z()}, direction); };
  const double y = place_of_maximum(reach_at, -half_width, half_width, 5.0);
  return Vector3d(centre.x(), y, centre.z()) + reach_at(y) * direction;
}

Vector3d OutlineProbe::underside(double station, double offset) const {
  const Vector3d below(station, offset, 0.0);
  return below - reach(below, -Vector3d::UnitZ()) * Vector3d::UnitZ();
}

Vector3d OutlineProbe::top(double station, double offset, double from) const {
  const auto at = [&](double z) { return value({station, offset, z}); };
  if (!(at(from) < 0.0)) return {station, offset, 0.0};
  double z = from;
  while (at(z) < 0.0) z += 0.25;
  return {station, offset, bisected(at, z - 0.25, z)};
}

}  // namespace instep
