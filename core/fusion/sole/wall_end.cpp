#include "core/fusion/sole/wall_end.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "core/fusion/sole/ground_plan.h"
#include "core/geometry/point_index.h"
#include "core/geometry/wall_facing.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kWallCellMm = 6.0;       // within it the lowest seen points are one piece of wall
constexpr double kLowestLayerMm = 1.5;    // above the lowest point, still taken as lowest
constexpr double kBesideMm = 12.0;        // of the ground searched for lower skin
constexpr double kSteepestBorder = 0.8;   // of an arch, seen from the side
constexpr double kLeastSameFacing = 0.3;  // cosine, of normals of one piece of wall
constexpr double kAsideMm = 8.0;          // of the points that tell how a wall ends
constexpr double kFewestWallPoints = 8;
constexpr double kRidge = 1e-3;  // keeps a fit to few or crowded points from leaning

PointCloud part_below(const PointCloud& cloud, double z) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.positions[i].z() < z) indices.push_back(i);
  }
  return cloud.subset(indices);
}

/// The lowest seen points above one cell.
struct LowestPoints {
  Vector3d position = Vector3d::Zero();  ///< mean
  Vector3d normal = Vector3d::Zero();    ///< sum
  double count = 0.0;
};

/// Of points of one height the same one counts, in whatever order they come.
bool is_lower(const Vector3d& a, const Vector3d& b) {
  return std::tie(a.z(), a.x(), a.y()) < std::tie(b.z(), b.x(), b.y());
}

/// The lowest point above each cell; at infinite height where there is none.
std::vector<Vector3d> lowest_places(const GroundPlan& plan, const PointCloud& foot) {
  const double none = std::numeric_limits<double>::infinity();
  std::vector<Vector3d> lowest(plan.cells(), Vector3d(none, none, none));
  for (const auto& point : foot.positions) {
    Vector3d& place = lowest[plan.cell_of(point)];
    if (is_lower(point, place)) place = point;
  }
  return lowest;
}

/// Whether the skin goes on downward close by, more steeply than the border of an arch rises: then
/// this is not its foot.
bool goes_on_below(const GroundPlan& plan, const std::vector<Vector3d>& lowest,
                   const Vector3d& place) {
  bool lower = false;
  plan.disc(place.head<2>(), kBesideMm, [&](std::size_t cell) {
    const double below = place.z() - lowest[cell].z();
    if (!(below > kLowestLayerMm)) return;
    const double aside = (place - lowest[cell]).head<2>().norm();
    lower = lower || below > kLowestLayerMm + kSteepestBorder * aside;
  });
  return lower;
}

std::vector<LowestPoints> lowest_points(const PointCloud& foot, double most_z) {
  const GroundPlan plan = GroundPlan::round(foot, kWallCellMm, kWallCellMm);
  const auto lowest = lowest_places(plan, foot);
  std::vector<LowestPoints> found(plan.cells());
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const auto& point = foot.positions[i];
    const std::size_t cell = plan.cell_of(point);
    if (point.z() > std::min(lowest[cell].z() + kLowestLayerMm, most_z)) continue;
    found[cell].position += point;
    found[cell].normal += foot.normals[i];
    found[cell].count += 1.0;
  }
  std::erase_if(found, [](const LowestPoints& points) { return points.count == 0.0; });
  for (auto& points : found) points.position /= points.count;
  std::erase_if(found, [&](const LowestPoints& points) {
    return points.normal.normalized().z() > kMostUpwardOfWall ||
           goes_on_below(plan, lowest, points.position);
  });
  return found;
}

/// Fits an arc to the wall above its lowest points: over the way up, nearer points counting more,
/// and a parabola over the way along. Positions, not normals: those were fitted in windows that end
/// where the seen skin does, and so belong to places further up.
std::optional<WallEnd> fit_end(const PointCloud& foot, const PointIndex& index,
                               const LowestPoints& lowest, double reach) {
  const Vector3d normal = lowest.normal.normalized();
  const Vector3d along = Vector3d::UnitZ().cross(normal).normalized();
  const Vector3d up = normal.cross(along);
  Matrix6 matrix = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  double count = 0.0;
  for (const auto& neighbour : index.within(lowest.position, reach)) {
    if (foot.normals[neighbour.index].dot(normal) < kLeastSameFacing) continue;
    const Vector3d offset = foot.positions[neighbour.index] - lowest.position;
    const double way = up.dot(offset);
    const double aside = along.dot(offset);
    if (std::abs(aside) > kAsideMm) continue;
    const double weight = std::exp(-0.5 * std::pow(2.0 * way / reach, 2));
    const double off = normal.dot(offset);
    Vector6 row;
    row << 1.0, way, way * way + off * off, aside, aside * aside, way * aside;
    matrix += weight * row * row.transpose();
    right += weight * off * row;
    count += weight;
  }
  if (count < kFewestWallPoints) return std::nullopt;
  matrix.diagonal().tail<5>().array() += kRidge * count;
  const Vector6 fitted = matrix.ldlt().solve(right);
  if (!fitted.allFinite()) return std::nullopt;
  // The circle bend (way^2 + off^2) + slope way - off + start = 0, where way = 0.
  const double start = fitted(0), slope = fitted(1), bend = fitted(2);
  const double root = 1.0 - 4.0 * bend * start;
  if (!(root > 0.0)) return std::nullopt;
  const double off = 2.0 * start / (1.0 + std::sqrt(root));
  WallEnd end;
  end.position = lowest.position + off * normal;
  end.normal = (normal * (1.0 - 2.0 * bend * off) - slope * up).normalized();
  end.bend = -2.0 * bend / std::sqrt(slope * slope + root);
  return end;
}

}  // namespace

std::vector<WallEnd> find_wall_ends(const PointCloud& foot, double most_z, double reach) {
  std::vector<WallEnd> ends;
  const PointCloud low = part_below(foot, most_z + reach);
  if (low.empty()) return ends;
  const PointIndex index(low.positions);
  for (const auto& lowest : lowest_points(low, most_z)) {
    const auto fitted = fit_end(low, index, lowest, reach);
    ends.push_back(fitted.value_or(WallEnd{lowest.position, lowest.normal.normalized(), 0.0}));
  }
  return ends;
}

}  // namespace instep
