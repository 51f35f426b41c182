#include "core/fusion/sole/close_sole.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/fusion/sole/ground_plan.h"
#include "core/fusion/sole/wall_foot.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Mask = GroundPlan::Mask;

constexpr double kBridgeMm = 8.0;  // gaps in the outline up to twice this are closed
constexpr double kSeenSoleHeightMm = 25.0;
constexpr double kSeenSoleNormal = -0.8;  // z of the normal of a sole seen from below
constexpr double kSidewaysMm = 4.0;       // standard deviation of the weight of walls to the side
constexpr double kFarthestSidewaysMm = 12.0;
constexpr double kBeyondContactMm = 6.0;  // how far a wall still says that there is contact
constexpr double kOverhangMm = 30.0;      // how far the skin reaches out above the foot of a wall

/// The ground under the low part of the foot, its inside filled.
Mask footprint(const GroundPlan& plan, const PointCloud& foot, double height) {
  Mask low(plan.cells(), 0);
  for (const auto& point : foot.positions) {
    if (point.z() < height + kHighestWallEndMm) low[plan.cell_of(point)] = 1;
  }
  return plan.shrunk(plan.filled(plan.grown(low, kBridgeMm)), kBridgeMm);
}

/// Where a camera saw the sole itself, with a margin.
Mask seen_sole(const GroundPlan& plan, const PointCloud& foot, double height) {
  Mask seen(plan.cells(), 0);
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const bool sole = foot.was_seen(i) && foot.normals[i].z() < kSeenSoleNormal &&
                      foot.positions[i].z() < height + kSeenSoleHeightMm;
    if (sole) seen[plan.cell_of(foot.positions[i])] = 1;
  }
  return plan.grown(seen, 2.0 * plan.cell_mm);
}

/// Height of the skin over the platform at a place under the foot; nothing where the nearest wall
/// says that the place lies outside.
std::optional<double> skin_height(const std::vector<WallFoot>& walls, const Vector2d& place,
                                  double least_inward) {
  const WallFoot* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  double weights = 0.0;
  double heights = 0.0;
  for (const auto& wall : walls) {
    const double squared = (place - wall.place()).squaredNorm();
    const double sideways = wall.sideways(place);
    if (std::abs(sideways) > kFarthestSidewaysMm) continue;
    const double inward = wall.inward(place);
    if (squared < least) {
      least = squared;
      nearest = &wall;
    }
    if (inward < least_inward || inward > wall.contact() + kBeyondContactMm) continue;
    const double weight = std::exp(-0.5 * std::pow(sideways / kSidewaysMm, 2));
    weights += weight;
    heights += weight * wall.skin_height(inward);
  }
  const bool outside =
      nearest && nearest->inward(place) < least_inward && least < kOverhangMm * kOverhangMm;
  if (outside) return std::nullopt;
  return weights > 0.0 ? heights / weights : 0.0;
}

/// The skin under a foot as heights over the platform, one a cell; nothing where none is to be
/// added.
using HeightMap = std::vector<std::optional<double>>;

/// Outward normal of the skin at a cell, from its neighbours' heights.
Vector3d normal_at(const GroundPlan& plan, const HeightMap& heights, int column, int row) {
  const double own = *heights[plan.at(column, row)];
  const auto slope = [&](int dx, int dy) {
    double sum = 0.0;
    double count = 0.0;
    for (const int sign : {-1, 1}) {
      const int x = column + sign * dx;
      const int y = row + sign * dy;
      if (x < 0 || y < 0 || x >= plan.columns || y >= plan.rows) continue;
      const auto& other = heights[plan.at(x, y)];
      if (!other) continue;
      sum += sign * (*other - own);
      count += 1.0;
    }
    return count > 0.0 ? sum / (count * plan.cell_mm) : 0.0;
  };
  return Vector3d(slope(1, 0), slope(0, 1), -1.0).normalized();
}

void add_point(PointCloud& cloud, const Vector3d& position, const Vector3d& normal,
               double sigma_mm) {
  cloud.positions.push_back(position);
  cloud.normals.push_back(normal);
  cloud.sigma_mm.push_back(sigma_mm);
  cloud.view_directions.push_back(-Vector3d::UnitZ());
  cloud.origins.push_back(PointOrigin::kPlatform);
}

/// The points of a height map.
PointCloud points_of(const GroundPlan& plan, const HeightMap& heights, double standing_height_mm,
                     double sigma_mm) {
  PointCloud sole;
  for (int row = 0; row < plan.rows; ++row) {
    for (int column = 0; column < plan.columns; ++column) {
      const auto& height = heights[plan.at(column, row)];
      if (!height) continue;
      const Vector2d place = plan.centre(column, row);
      add_point(sole, {place.x(), place.y(), standing_height_mm + *height},
                normal_at(plan, heights, column, row), sigma_mm);
    }
  }
  return sole;
}

/// The hidden walls themselves, on which, steep as they are, a map of heights has hardly a point.
PointCloud points_of(const std::vector<WallFoot>& walls, const GroundPlan& plan,
                     const Mask& seen_sole, double standing_height_mm,
                     const SoleSettings& settings) {
  PointCloud skin;
  for (const auto& wall : walls) {
    const Vector2d along(-wall.out().y(), wall.out().x());
    for (const auto& place : wall.hidden_wall(settings.spacing_mm)) {
      const Vector2d level = std::sqrt(1.0 - place.sine_of_dip * place.sine_of_dip) * wall.out();
      for (const double side : {-1.0, 0.0, 1.0}) {
        const Vector2d ground =
            wall.place() - place.inward * wall.out() + side * settings.spacing_mm * along;
        const Vector3d point(ground.x(), ground.y(), standing_height_mm + place.height);
        if (seen_sole[plan.cell_of(point)]) continue;
        add_point(skin, point, {level.x(), level.y(), -place.sine_of_dip}, settings.sigma_mm);
      }
    }
  }
  return skin;
}

}  // namespace

SoleClosure close_sole(PointCloud& foot, double standing_height_mm, const SoleSettings& settings) {
  SoleClosure closure;
  if (foot.empty() || !foot.has_normals()) return closure;
  const GroundPlan plan = GroundPlan::round(foot, settings.spacing_mm, 2.5 * kBridgeMm);
  const Mask print = footprint(plan, foot, standing_height_mm);
  const Mask seen = seen_sole(plan, foot, standing_height_mm);
  const auto walls = find_wall_feet(foot, standing_height_mm);
  for (const auto& wall : walls) {
    closure.widest_inset_mm = std::max(closure.widest_inset_mm, wall.contact());
  }
  HeightMap heights(plan.cells());
  for (int row = 0; row < plan.rows; ++row) {
    for (int column = 0; column < plan.columns; ++column) {
      const std::size_t cell = plan.at(column, row);
      if (!print[cell] || seen[cell]) continue;
      heights[cell] = skin_height(walls, plan.centre(column, row), 0.5 * settings.spacing_mm);
    }
  }
  const PointCloud sole = points_of(plan, heights, standing_height_mm, settings.sigma_mm);
  const PointCloud hidden = points_of(walls, plan, seen, standing_height_mm, settings);
  foot.append(sole);
  foot.append(hidden);
  closure.points_added = sole.size() + hidden.size();
  return closure;
}

}  // namespace instep
