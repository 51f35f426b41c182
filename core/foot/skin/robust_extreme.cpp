#include "core/foot/skin/robust_extreme.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/geometry/quadratic_skin.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kMostExtreme = 5;
constexpr std::size_t kGaps = 4;  ///< between points of an end, that tell how close they lie
constexpr std::size_t kMostStrays = 2;
constexpr std::size_t kFurthest = kMostStrays + kGaps + 1;
/// Against the next ones: of points at random one gap in eighty is as wide.
constexpr double kGapOfStray = 8.0;
constexpr double kWidestMm = 6.0;
constexpr double kNarrowestMm = 3.0;
/// The patch reaches so far, as a share of the skin's radius there: on a toe's tip a wider one is
/// no quadratic any more.
constexpr double kShareOfRadius = 0.7;
/// Where points are few, as the corners of a coarse mesh, it is widened up to so many times.
constexpr double kWidenedAtMost = 2.0;
constexpr double kWider = 1.25;
/// Deeper points are of another face: the sole behind the edge of a toe.
constexpr double kDeepestMm = 4.0;
constexpr std::size_t kFewestForSummit = 12;
constexpr double kLargestCorrectionMm = 2.5;
constexpr double kLargestOfFewMm = 6.0;
constexpr int kRounds = 4;
/// The start is one of the points, and after a move of half of the widest patch lies just on the
/// rim of the narrowest: rounding must not tell whether it counts.
constexpr double kOnRim = 1.0 + 1e-9;

/// The points that reach furthest, the furthest first.
std::vector<Vector3d> furthest_of(const std::vector<Vector3d>& points, const Vector3d& direction) {
  std::vector<Vector3d> furthest(std::min(kFurthest, points.size()));
  std::partial_sort_copy(
      points.begin(), points.end(), furthest.begin(), furthest.end(),
      [&](const Vector3d& a, const Vector3d& b) { return direction.dot(a) > direction.dot(b); });
  return furthest;
}

/// How far a round end reaches of which few points are known: they are spread evenly over how far
/// they lie behind it (Archimedes), so that it is as far before the first as each is before the
/// next one on average. One or two that are far before the others are strays.
double reach_of_few(const std::vector<Vector3d>& furthest, const Vector3d& direction) {
  const auto reach = [&](std::size_t i) { return direction.dot(furthest[i]); };
  const auto usual_gap = [&](std::size_t first) {
    return (reach(first) - reach(first + kGaps)) / static_cast<double>(kGaps);
  };
  std::size_t first = kMostStrays;
  while (first > 0 && reach(first - 1) - reach(first) <= kGapOfStray * usual_gap(first)) --first;
  return reach(first) + usual_gap(first);
}

SkinPatch within(const SkinPatch& patch, const Vector2d& middle, double radius) {
  SkinPatch close;
  for (const auto& point : patch) {
    const Vector2d offset = point.head<2>() - middle;
    if (offset.squaredNorm() < kOnRim * radius * radius) {
      close.emplace_back(offset.x(), offset.y(), point.z());
    }
  }
  return close;
}

/// The points round a place, of as narrow a circle as holds enough of them; fewer where none does.
SkinPatch enough_within(const SkinPatch& patch, const Vector2d& middle, double& radius) {
  SkinPatch close = within(patch, middle, radius);
  if (close.size() < kFewestForSummit) radius = kWidestMm;
  for (; close.size() < kFewestForSummit && radius < kWidenedAtMost * kWidestMm; radius *= kWider) {
    close = within(patch, middle, radius);
  }
  return close;
}

struct Dome {
  Vector2d vertex = Vector2d::Zero();
  double least_radius = 0.0;
};

/// The summit of a quadratic and its tighter radius, if it is a dome.
std::optional<Dome> dome_of(const QuadraticSkin& skin) {
  const auto& c = skin.coefficients();
  Eigen::Matrix2d hessian;
  hessian << 2.0 * c(3), c(4), c(4), 2.0 * c(5);
  const Eigen::Vector2d bends =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(hessian, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(bends(1) < 0.0 && hessian.determinant() > 1e-8)) return std::nullopt;
  return Dome{hessian.inverse() * Vector2d(-c(1), -c(2)), -1.0 / bends(0)};
}

/// Where a patch reaches furthest, seen from the start.
struct Summit {
  Vector2d middle = Vector2d::Zero();
  std::optional<double> reach;  ///< nothing where the points tell no surface
  bool is_of_few = false;       ///< fewer than a surface asks for
};

Summit summit_of(const SkinPatch& patch) {
  Summit summit;
  double radius = kWidestMm;
  for (int round = 0; round < kRounds; ++round) {
    const SkinPatch close = enough_within(patch, summit.middle, radius);
    summit.is_of_few = close.size() < kFewestForSummit;
    if (summit.is_of_few) break;
    const auto skin = QuadraticSkin::through(close);
    if (!skin) break;
    summit.reach = skin->at(0.0, 0.0);
    const auto dome = dome_of(*skin);
    if (!dome) break;
    // No further at once than the patch knows.
    const double step = dome->vertex.norm();
    const Vector2d move =
        step > 0.5 * radius ? Vector2d(dome->vertex * (0.5 * radius / step)) : dome->vertex;
    if ((summit.middle + move).norm() > kWidestMm) break;
    summit.reach = skin->at(move.x(), move.y());
    summit.middle += move;
    radius = std::clamp(kShareOfRadius * dome->least_radius, kNarrowestMm, kWidestMm);
  }
  return summit;
}

}  // namespace

Vector3d robust_extreme(const std::vector<Vector3d>& points, const Vector3d& direction) {
  const auto furthest = furthest_of(points, direction);
  const Vector3d start = furthest[std::min(kMostExtreme, furthest.size()) / 2];
  const Vector3d across = direction.unitOrthogonal();
  const Vector3d upright = direction.cross(across);
  SkinPatch patch;
  for (const auto& point : points) {
    const Vector3d offset = point - start;
    if (offset.norm() > kWidenedAtMost * kWidestMm) continue;
    if (direction.dot(offset) < -kDeepestMm) continue;
    patch.emplace_back(across.dot(offset), upright.dot(offset), direction.dot(offset));
  }
  const Summit summit = summit_of(patch);
  if (!summit.reach && summit.is_of_few && furthest.size() == kFurthest) {
    const double further = reach_of_few(furthest, direction) - direction.dot(start);
    return start + std::min(further, kLargestOfFewMm) * direction;
  }
  if (!summit.reach || !(std::abs(*summit.reach) < kLargestCorrectionMm)) return start;
  return start + summit.middle.x() * across + summit.middle.y() * upright +
         *summit.reach * direction;
}

}  // namespace instep
