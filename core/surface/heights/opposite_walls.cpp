#include "core/surface/heights/opposite_walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/geometry/moments.h"
#include "core/mean.h"
#include "core/stride.h"

namespace instep {
namespace {

constexpr std::size_t kFewestOnAWall = 6;
constexpr int kRounds = 8;
/// What two planes leave of the variance round one plane: of a noisy sheet that is cut in two
/// layers a third or more.
constexpr double kExplained = 0.1;
/// The same as twice the logarithm of a likelihood: of a dozen points noise leaves as little.
constexpr double kLeastGain = 50.0;
/// Least cosine between their normals, and of either to the direction in which they lie over each
/// other.
constexpr double kNearlyParallel = 0.5;
constexpr double kFacing = 0.5;
/// Walls that face more along the third axis are none that a plane across it cuts: two level rows
/// of points round an edge look like them.
constexpr double kLevel = 0.7;
/// Of the points, seen along the normals, those whose nearest one is of the other wall: of walls
/// that lie over each other half, or a third where one has four times the points; of the two sides
/// of a roof, by 40 points, a twentieth.
constexpr double kInterleaved = 0.25;
constexpr std::size_t kMostAsked = 256;
/// Points of a wall spread by this much of their length across it at least (sums of squares).
constexpr double kThinLine = 0.08;

using Sides = std::vector<std::uint8_t>;
using Points = std::vector<Eigen::Vector3d>;

/// Of the points on one side; nothing of too few or of a line.
std::optional<FittedPlane> wall_of(const Points& points, const Sides& sides, std::uint8_t side) {
  Moments moments;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sides[i] == side) moments.add(points[i] - points.front());
  }
  if (moments.count < static_cast<double>(kFewestOnAWall)) return std::nullopt;
  const auto axes = moments.axes();
  if (are_on_a_line(axes, kThinLine)) return std::nullopt;
  return FittedPlane{points.front() + moments.middle(), axes.eigenvectors().col(0)};
}

/// Of heights over one plane.
Sides sides_by_height(const Points& points, const Eigen::Vector3d& flattest) {
  std::vector<double> heights;
  for (const auto& point : points) heights.push_back(flattest.dot(point - points.front()));
  const double mean = mean_of(heights);
  Sides sides;
  for (const double height : heights) sides.push_back(height > mean);
  return sides;
}

/// Variance of what is left over planes of three parameters each.
double variance_of(double squares, std::size_t points, std::size_t planes) {
  const auto freedom = static_cast<double>(points) - 3.0 * static_cast<double>(planes);
  return freedom > 0.0 ? squares / freedom : std::numeric_limits<double>::infinity();
}

/// Whether the walls lie over each other, seen along a direction: an even part of many points tells
/// it, each against all.
bool are_interleaved(const Points& points, const Sides& sides, const Eigen::Vector3d& direction) {
  std::size_t mixed = 0;
  std::size_t asked = 0;
  const std::size_t stride = stride_to_at_most(kMostAsked, points.size());
  for (std::size_t i = 0; i < points.size(); i += stride) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t other = i;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const double square = direction.cross(points[j] - points[i]).squaredNorm();
      if (j == i || square >= nearest) continue;
      nearest = square;
      other = j;
    }
    if (sides[other] != sides[i]) ++mixed;
    ++asked;
  }
  return static_cast<double>(mixed) > kInterleaved * static_cast<double>(asked);
}

/// Of each point the nearer one, until nothing changes or the last of the rounds.
std::optional<OppositeWalls> parted_across(const Points& points, const Eigen::Vector3d& across) {
  OppositeWalls walls{{}, sides_by_height(points, across)};
  for (int round = 0; round < kRounds; ++round) {
    const auto first = wall_of(points, walls.sides, 0);
    const auto second = wall_of(points, walls.sides, 1);
    if (!first || !second) return std::nullopt;
    walls.both = {*first, *second};
    Sides sides;
    for (const auto& point : points) {
      sides.push_back(second->distance(point) < first->distance(point));
    }
    std::swap(sides, walls.sides);
    if (sides == walls.sides) break;
  }
  return walls;
}

/// Whether they explain the points plainly better than one plane, which leaves `of_one` of them.
bool is_plain(const OppositeWalls& walls, const Points& points, double of_one) {
  double squares = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    squares += std::pow(walls.both[walls.sides[i]].distance(points[i]), 2);
  }
  const double of_both = variance_of(squares, points.size(), 2);
  if (!(of_both < kExplained * of_one)) return false;
  return static_cast<double>(points.size()) * std::log(of_one / of_both) > kLeastGain;
}

/// Whether they lie over each other, seen along a direction that they face.
bool are_opposite(const OppositeWalls& walls, const Points& points,
                  const Eigen::Vector3d& direction) {
  const auto& [first, second] = walls.both;
  if (std::max(std::abs(first.normal.z()), std::abs(second.normal.z())) > kLevel) return false;
  if (std::abs(first.normal.dot(second.normal)) < kNearlyParallel) return false;
  if (std::abs(first.normal.dot(direction)) < kFacing) return false;
  if (std::abs(second.normal.dot(direction)) < kFacing) return false;
  return are_interleaved(points, walls.sides, direction);
}

}  // namespace

std::optional<OppositeWalls> OppositeWalls::among(const Points& points) {
  if (points.size() < 2 * kFewestOnAWall) return std::nullopt;
  const auto axes = Moments::of(points).axes();
  const auto whole = wall_of(points, Sides(points.size(), 0), 0);
  if (!whole) return std::nullopt;
  double squares = 0.0;
  for (const auto& point : points) squares += std::pow(whole->distance(point), 2);
  const double variance = variance_of(squares, points.size(), 1);
  // Of a wedge that is cut off before its edge the walls are further apart than wide.
  for (const Eigen::Index axis : {0, 1}) {
    const Eigen::Vector3d across = axes.eigenvectors().col(axis);
    auto walls = parted_across(points, across);
    if (walls && is_plain(*walls, points, variance) && are_opposite(*walls, points, across))
      return walls;
  }
  return std::nullopt;
}

}  // namespace instep
