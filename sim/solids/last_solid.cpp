#include "sim/solids/last_solid.h"

#include <algorithm>
#include <cmath>

namespace instep {
namespace {

constexpr double kHeelLiftMm = 20.0;
constexpr double kBallStationMm = 165.0;
constexpr double kTopMm = 105.0;

/// Height of the sole at station x: falls smoothly from the heel seat to the ball, rises to the
/// toe. Its slope stays below 0.3.
double sole_height(double x) {
  const double behind = std::clamp((kBallStationMm - x) / 120.0, 0.0, 1.0);
  const double heel = kHeelLiftMm * behind * behind * (3.0 - 2.0 * behind);
  const double ahead = std::max(0.0, x - kBallStationMm);
  return heel + 0.0009 * ahead * ahead;
}

}  // namespace

LastSolid::LastSolid() : upper_(6.0) {
  upper_.add({{29, 0, 30}, 29, {36, 0, 90}, 26});
  upper_.add({{40, -2, 28}, 27, {150, -14, 12}, 27});
  upper_.add({{55, 2, 80}, 24, {120, 4, 40}, 22});
  upper_.add({{120, 4, 38}, 20, {175, 14, 14}, 26});
  upper_.add({{150, -14, 12}, 27, {205, -14, 10}, 20});
  upper_.add({{175, 14, 14}, 26, {232, 4, 14}, 18});
  upper_.add({{205, -14, 10}, 20, {232, 4, 14}, 18});
  bounds_ = upper_.bounds();
  bounds_.min().z() = 0.0;
  bounds_.max().z() = kTopMm;
}

double LastSolid::value(const Eigen::Vector3d& point) const {
  constexpr double kSteepestSole = 1.05;
  const double below = (sole_height(point.x()) - point.z()) / kSteepestSole;
  const double above = point.z() - kTopMm;
  return std::max({upper_.value(point), below, above});
}

}  // namespace instep
