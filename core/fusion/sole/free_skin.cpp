#include "core/fusion/sole/free_skin.h"

#include <cmath>
#include <cstddef>

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kPieces = 48;
constexpr double kMostFalloff = 8.0;
constexpr int kHalvings = 8;

/// From the contact on, for a skin of unit length: distance from it and height.
std::vector<Vector2d> from_contact(double turn, double falloff) {
  std::vector<Vector2d> corners{Vector2d::Zero()};
  for (std::size_t i = 0; i < kPieces; ++i) {
    const double way = (static_cast<double>(i) + 0.5) / kPieces;
    const double angle = turn * std::pow(way, falloff + 1.0);
    corners.push_back(corners.back() + Vector2d(std::cos(angle), std::sin(angle)) / kPieces);
  }
  return corners;
}

/// Curvature where the skin begins, times its height.
double first_bend(double turn, double falloff) {
  return (falloff + 1.0) * turn * from_contact(turn, falloff).back().y();
}

}  // namespace

std::vector<Vector2d> free_skin(double turn, double falloff, double height) {
  const auto unit = from_contact(turn, falloff);
  const double length = height / unit.back().y();
  std::vector<Vector2d> corners;
  for (auto corner = unit.rbegin(); corner != unit.rend(); ++corner) {
    corners.push_back(length * Vector2d(unit.back().x() - corner->x(), corner->y()));
  }
  return corners;
}

double falloff_of_bend(double turn, double bend_of_height) {
  double least = 0.0;
  double most = kMostFalloff;
  if (bend_of_height <= first_bend(turn, least)) return least;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (least + most) / 2.0;
    (first_bend(turn, middle) < bend_of_height ? least : most) = middle;
  }
  return (least + most) / 2.0;
}

}  // namespace instep
