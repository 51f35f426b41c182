#include "core/surface/opposite_walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/geometry/moments.h"

namespace instep {
namespace {

constexpr std::size_t kFewestOnAWall = 6;
constexpr int kRounds = 8;
/// What two planes leave of the variance round one plane: of a noisy sheet that is cut in two
/// layers a third or more.
constexpr double kExplained = 0.1;
/// Least cosine between their normals.
constexpr double kNearlyParallel = 0.5;
/// Of the points, seen along the normals, those whose nearest one is of the other wall: of walls
/// that lie over each other half, or a third where one has four times the points; of the two sides
/// of a roof a seventh.
constexpr double kInterleaved = 0.25;
/// Points of a wall spread by this much of their length across it at least (sums of squares).
constexpr double kThinLine = 0.08;

using Sides = std::vector<std::uint8_t>;
using Points = std::vector<Eigen::Vector3d>;

/// Of the points on one side; nothing of too few or of a line.
std::optional<OppositeWalls::Wall> wall_of(const Points& points, const Sides& sides,
                                           std::uint8_t side) {
  Moments moments;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sides[i] == side) moments.add(points[i] - points.front());
  }
  if (moments.count < static_cast<double>(kFewestOnAWall)) return std::nullopt;
  const auto axes = moments.axes();
  if (axes.eigenvalues()[1] < kThinLine * axes.eigenvalues()[2]) return std::nullopt;
  return OppositeWalls::Wall{points.front() + moments.middle(), axes.eigenvectors().col(0)};
}

/// Of heights over one plane.
Sides sides_by_height(const Points& points, const Eigen::Vector3d& flattest) {
  std::vector<double> heights;
  double mean = 0.0;
  for (const auto& point : points) heights.push_back(flattest.dot(point - points.front()));
  for (const double height : heights) mean += height / static_cast<double>(heights.size());
  Sides sides;
  for (const double height : heights) sides.push_back(height > mean);
  return sides;
}

/// Variance of what is left over planes of three parameters each.
double variance_of(double squares, std::size_t points, std::size_t planes) {
  const auto freedom = static_cast<double>(points) - 3.0 * static_cast<double>(planes);
  return freedom > 0.0 ? squares / freedom : std::numeric_limits<double>::infinity();
}

/// Whether the walls lie over each other, seen along a direction.
bool are_interleaved(const Points& points, const Sides& sides, const Eigen::Vector3d& direction) {
  std::size_t mixed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t other = i;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const double square = direction.cross(points[j] - points[i]).squaredNorm();
      if (j == i || square >= nearest) continue;
      nearest = square;
      other = j;
    }
    if (sides[other] != sides[i]) ++mixed;
  }
  return static_cast<double>(mixed) > kInterleaved * static_cast<double>(points.size());
}

}  // namespace

std::optional<OppositeWalls> OppositeWalls::among(const Points& points,
                                                  const Eigen::Vector3d& flattest) {
  if (points.size() < 2 * kFewestOnAWall) return std::nullopt;
  const auto whole = wall_of(points, Sides(points.size(), 0), 0);
  if (!whole) return std::nullopt;
  Sides sides = sides_by_height(points, flattest);
  double squares = 0.0;
  OppositeWalls walls;
  for (int round = 0; round < kRounds; ++round) {
    const auto first = wall_of(points, sides, 0);
    const auto second = wall_of(points, sides, 1);
    if (!first || !second) return std::nullopt;
    walls.walls = {*first, *second};
    Sides anew;
    squares = 0.0;
    for (const auto& point : points) {
      const double to_first = first->distance(point);
      const double to_second = second->distance(point);
      anew.push_back(to_second < to_first);
      squares += std::pow(std::min(to_first, to_second), 2);
    }
    if (anew == sides) break;
    sides = std::move(anew);
  }
  double squares_of_one = 0.0;
  for (const auto& point : points) squares_of_one += std::pow(whole->distance(point), 2);
  const double one = variance_of(squares_of_one, points.size(), 1);
  if (!(variance_of(squares, points.size(), 2) < kExplained * one)) return std::nullopt;
  if (std::abs(walls.walls[0].normal.dot(walls.walls[1].normal)) < kNearlyParallel)
    return std::nullopt;
  if (!are_interleaved(points, sides, flattest)) return std::nullopt;
  walls.sides = std::move(sides);
  return walls;
}

}  // namespace instep
