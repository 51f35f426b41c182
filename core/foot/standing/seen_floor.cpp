#include "core/foot/standing/seen_floor.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/geometry/moments.h"
#include "core/geometry/plane_vectors.h"
#include "core/geometry/polygon.h"
#include "core/median.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// So high above the plane nothing is of the floor, and any body reaches further out than where it
/// touches it.
constexpr double kBodyMm = 8.0;
constexpr double kHighestMm = 120.0;
constexpr double kCellMm = 4.0;
/// A cell with fewer points may hold a stray.
constexpr std::size_t kFewestOfBody = 2;
/// Beside what the body covers, which is known to within a cell.
constexpr double kBesideMm = 3.0;
constexpr double kThickMm = 3.0;
constexpr double kThickInScatters = 4.0;
/// What a sole leaves there is nothing; a rim round a foot, some 600 mm long, covers as much if it
/// reaches two millimetres further.
constexpr double kLeastAreaMm2 = 1000.0;
constexpr std::size_t kSides = 24;
constexpr std::size_t kFewestSides = 8;
/// Noisier, or further from the plane, is none; nor are points of which fewer lie on one level.
constexpr double kMostScatterMm = 2.0;
constexpr double kMostTilt = 0.05;  ///< sine
constexpr double kLeastOnLevel = 0.8;
constexpr int kRounds = 3;
/// Skin over the rim of a body that was cut off above its floor climbs to what stands higher: over
/// two feet cut 15 to 40 mm over the floor by 0.08 to 0.6.
constexpr double kMostClimb = 0.05;

using Cell = std::pair<long, long>;

Cell cell_of(const Vector3d& point) {
  return {std::lround(point.x() / kCellMm), std::lround(point.y() / kCellMm)};
}

/// What the body covers as seen from above.
std::vector<Vector2d> covered(const std::vector<Vector3d>& standing) {
  std::map<Cell, std::size_t> cells;
  for (const auto& point : standing) {
    if (point.z() > kBodyMm && point.z() < kHighestMm) ++cells[cell_of(point)];
  }
  std::vector<Vector2d> places;
  for (const auto& [cell, points] : cells) {
    if (points < kFewestOfBody) continue;
    places.emplace_back(kCellMm * static_cast<double>(cell.first),
                        kCellMm * static_cast<double>(cell.second));
  }
  return places.size() < 3 ? std::vector<Vector2d>() : convex_hull(std::move(places));
}

/// Low points beside what the body covers.
std::vector<Vector3d> low_beside(const std::vector<Vector3d>& standing,
                                 const std::vector<Vector2d>& hull) {
  std::vector<Vector3d> beside;
  for (const auto& point : standing) {
    if (std::abs(point.z()) < kBodyMm && -depth_in(hull, point.head<2>()) > kBesideMm) {
      beside.push_back(point);
    }
  }
  return beside;
}

/// Whether points cover enough ground on enough sides of the middle.
bool surround(const std::vector<Vector3d>& points, const Vector2d& middle) {
  std::set<Cell> cells;
  std::set<std::size_t> sides;
  for (const auto& point : points) {
    cells.insert(cell_of(point));
    sides.insert(sector_of(point.head<2>() - middle, kSides));
  }
  return static_cast<double>(cells.size()) * kCellMm * kCellMm >= kLeastAreaMm2 &&
         sides.size() >= kFewestSides;
}

struct Level {
  Vector3d middle;
  Vector3d up;
  double scatter_mm;

  double height_of(const Vector3d& point) const { return up.dot(point - middle); }
};

Level level_through(const std::vector<Vector3d>& points) {
  const Moments moments = Moments::of(points);
  const SpreadAxes axes = moments.axes();
  Vector3d up = axes.eigenvectors().col(0);
  if (up.z() < 0.0) up = -up;
  return {points.front() + moments.middle(), up,
          std::sqrt(std::max(0.0, axes.eigenvalues()[0]) / moments.count)};
}

double thickness_of(const Level& level) {
  return std::max(kThickMm, kThickInScatters * level.scatter_mm);
}

/// The level that most of the points lie on, and those that do.
std::optional<Level> level_of(std::vector<Vector3d>& points) {
  std::vector<double> heights;
  for (const auto& point : points) heights.push_back(point.z());
  Level level{Vector3d(0.0, 0.0, median(std::move(heights))), Vector3d::UnitZ(), 0.0};
  const auto all = static_cast<double>(points.size());
  for (int round = 0; round < kRounds; ++round) {
    std::erase_if(points, [&](const Vector3d& point) {
      return std::abs(level.height_of(point)) > thickness_of(level);
    });
    const auto left = static_cast<double>(points.size());
    if (left < 3.0 || left < kLeastOnLevel * all) return std::nullopt;
    level = level_through(points);
  }
  const bool is_level = level.scatter_mm < kMostScatterMm && level.up.head<2>().norm() < kMostTilt;
  return is_level ? std::optional(level) : std::nullopt;
}

/// Whether points rise towards what the body covers, by more than their scatter may feign.
bool climbs_to_body(const std::vector<Vector3d>& beside, const Level& level,
                    const std::vector<Vector2d>& hull) {
  const auto count = static_cast<Eigen::Index>(beside.size());
  Eigen::VectorXd away(count);
  Eigen::VectorXd height(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vector3d& point = beside[static_cast<std::size_t>(i)];
    away[i] = -depth_in(hull, point.head<2>());
    height[i] = level.height_of(point);
  }
  away.array() -= away.mean();
  const double climb = -away.dot(height) / away.squaredNorm();
  const double feigned = kDeviations * level.scatter_mm / away.norm();
  return climb > kMostClimb + feigned;
}

}  // namespace

std::optional<SeenFloor> seen_floor(const std::vector<Vector3d>& points,
                                    const StandingPlane& plane) {
  const RigidTransform standing_from_input = plane.standing_from_input();
  std::vector<Vector3d> standing;
  standing.reserve(points.size());
  for (const auto& point : points) standing.push_back(standing_from_input * point);
  const auto hull = covered(standing);
  if (hull.size() < 3) return std::nullopt;
  auto beside = low_beside(standing, hull);
  if (beside.empty()) return std::nullopt;
  const auto level = level_of(beside);
  Vector2d middle = Vector2d::Zero();
  for (const auto& corner : hull) middle += corner / static_cast<double>(hull.size());
  if (!level || !surround(beside, middle)) return std::nullopt;
  if (climbs_to_body(beside, *level, hull)) return std::nullopt;
  SeenFloor floor;
  floor.plane.up = standing_from_input.inverse().linear() * level->up;
  floor.plane.height_mm = floor.plane.up.dot(standing_from_input.inverse() * level->middle);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (level->height_of(standing[i]) > thickness_of(*level)) floor.above.push_back(i);
  }
  return floor;
}

}  // namespace instep
