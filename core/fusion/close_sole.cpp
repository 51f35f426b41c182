#include "core/fusion/close_sole.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWallCellMm = 6.0;     // within it the lowest seen points are one piece of wall
constexpr double kLowestLayerMm = 1.5;  // above the lowest point, still taken as lowest
constexpr double kSeenSoleHeightMm = 25.0;
constexpr double kSeenSoleNormal = -0.8;    // z of the normal of a sole seen from below
constexpr double kLeastLean = 0.15;         // sine of a wall's lean that is not its noise
constexpr double kRadiusOfLean = 60.0;      // mm of radius that a lean allows
constexpr double kWidestRoundingMm = 12.0;  // a contact no further in lies below a rounded edge
constexpr double kNarrowestArchMm = 24.0;   // and one at least so far beyond an arch
constexpr double kClearingMm = 12.0;        // radius, so that discs of neighbouring cells overlap
constexpr int kMostCells = 4000;            // a side; a foot needs some 200

/// A map of the platform from above.
struct Plan {
  Vector2d corner;
  double cell_mm = 1.0;
  int columns = 0;
  int rows = 0;

  static Plan round(const PointCloud& cloud, double cell_mm, double margin_mm) {
    Vector2d least = cloud.positions.front().head<2>();
    Vector2d most = least;
    for (const auto& point : cloud.positions) {
      least = least.cwiseMin(point.head<2>());
      most = most.cwiseMax(point.head<2>());
    }
    Plan plan;
    plan.cell_mm = cell_mm;
    plan.corner = least.array() - margin_mm;
    const Vector2d size = (most - least).array() + 2 * margin_mm;
    plan.columns = std::min(kMostCells, static_cast<int>(size.x() / cell_mm) + 2);
    plan.rows = std::min(kMostCells, static_cast<int>(size.y() / cell_mm) + 2);
    return plan;
  }

  std::size_t cells() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row * columns + column);
  }
  int column_of(double x) const {
    return std::clamp(static_cast<int>((x - corner.x()) / cell_mm), 0, columns - 1);
  }
  int row_of(double y) const {
    return std::clamp(static_cast<int>((y - corner.y()) / cell_mm), 0, rows - 1);
  }
  std::size_t cell_of(const Vector3d& point) const {
    return at(column_of(point.x()), row_of(point.y()));
  }
  Vector2d centre(int column, int row) const {
    return corner + cell_mm * Vector2d(column + 0.5, row + 0.5);
  }

  /// Calls `visit(cell)` for the cells whose centres lie within `radius` of a place.
  template <typename Visit>
  void disc(const Vector2d& place, double radius, const Visit& visit) const {
    for (int row = row_of(place.y() - radius); row <= row_of(place.y() + radius); ++row) {
      for (int column = column_of(place.x() - radius); column <= column_of(place.x() + radius);
           ++column) {
        if ((centre(column, row) - place).norm() <= radius) visit(at(column, row));
      }
    }
  }
};

using Mask = std::vector<std::uint8_t>;

Mask grown(const Plan& plan, const Mask& mask, double radius) {
  Mask larger(mask.size(), 0);
  for (int row = 0; row < plan.rows; ++row) {
    for (int column = 0; column < plan.columns; ++column) {
      if (!mask[plan.at(column, row)]) continue;
      plan.disc(plan.centre(column, row), radius, [&](std::size_t cell) { larger[cell] = 1; });
    }
  }
  return larger;
}

/// What cannot be reached from the rim of the plan without crossing the mask, the mask included.
Mask filled(const Plan& plan, const Mask& mask) {
  Mask inside(mask.size(), 1);
  std::vector<std::pair<int, int>> open = {{0, 0}};
  inside[0] = 0;
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int x = column + dx;
      const int y = row + dy;
      if (x < 0 || y < 0 || x >= plan.columns || y >= plan.rows) continue;
      if (mask[plan.at(x, y)] || !inside[plan.at(x, y)]) continue;
      inside[plan.at(x, y)] = 0;
      open.emplace_back(x, y);
    }
  }
  return inside;
}

Mask inverted(Mask mask) {
  for (auto& cell : mask) cell = cell ? 0 : 1;
  return mask;
}

/// The ground under the low part of the foot, its inside filled.
Mask footprint(const Plan& plan, const PointCloud& foot, double height,
               const SoleSettings& settings) {
  Mask low(plan.cells(), 0);
  for (const auto& point : foot.positions) {
    if (point.z() < height + settings.outline_below_mm) low[plan.cell_of(point)] = 1;
  }
  const Mask closed = filled(plan, grown(plan, low, settings.bridge_mm));
  return inverted(grown(plan, inverted(closed), settings.bridge_mm));
}

/// The lowest seen part of the wall above one wall cell.
struct WallFoot {
  Vector3d position = Vector3d::Zero();  ///< mean
  Vector3d normal = Vector3d::Zero();    ///< sum
  double count = 0.0;
};

std::vector<WallFoot> wall_feet(const PointCloud& foot, double height,
                                const SoleSettings& settings) {
  const Plan plan = Plan::round(foot, kWallCellMm, kWallCellMm);
  std::vector<double> lowest(plan.cells(), std::numeric_limits<double>::infinity());
  for (const auto& point : foot.positions) {
    // A point also counts for the cells round its own: a wall that leans hides none of its foot.
    plan.disc(point.head<2>(), 1.5 * kWallCellMm,
              [&](std::size_t cell) { lowest[cell] = std::min(lowest[cell], point.z()); });
  }
  std::vector<WallFoot> feet(plan.cells());
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const auto& point = foot.positions[i];
    const std::size_t cell = plan.cell_of(point);
    if (point.z() > std::min(lowest[cell] + kLowestLayerMm, height + settings.outline_below_mm))
      continue;
    feet[cell].position += point;
    feet[cell].normal += foot.normals[i];
    feet[cell].count += 1.0;
  }
  std::erase_if(feet, [](const WallFoot& wall) { return wall.count == 0.0; });
  for (auto& wall : feet) wall.position /= wall.count;
  return feet;
}

/// Distance, inward from the wall, at which its rounding meets the platform.
double contact_distance(const WallFoot& wall, double height, const SoleSettings& settings) {
  const Vector3d normal = wall.normal.normalized();
  const double down = std::clamp(-normal.z(), -1.0, 0.95);
  const double out = std::sqrt(1.0 - down * down);
  const double above = std::max(0.0, wall.position.z() - height);
  // An upright wall whose foot was hidden says nothing of its rounding; one that leans in, as under
  // an arch, does.
  const double largest =
      settings.usual_radius_mm + kRadiusOfLean * std::max(0.0, down - kLeastLean) / (1.0 - down);
  const double distance = std::min(above / (1.0 - down), largest) * out;
  const double arch =
      std::clamp((distance - kWidestRoundingMm) / (kNarrowestArchMm - kWidestRoundingMm), 0.0, 1.0);
  const double factor = std::lerp(settings.inset_factor, settings.arch_factor, arch);
  return std::clamp(factor * distance, settings.least_inset_mm, settings.most_inset_mm);
}

/// Clears the ground between a wall and its contact line, which the last disc touches from outside,
/// and some ground outside the wall. Discs, not one large one: the contact beside an arch stays.
void clear_hollow(const Plan& plan, const WallFoot& wall, double inset, Mask& closing) {
  const Vector2d out = wall.normal.head<2>().normalized();
  const auto clear = [&](double distance) {
    plan.disc(wall.position.head<2>() - (distance - kClearingMm) * out, kClearingMm,
              [&](std::size_t cell) { closing[cell] = 0; });
  };
  for (double distance = inset; distance > kClearingMm; distance -= kWallCellMm) clear(distance);
  clear(std::min(inset, kClearingMm));
}

/// Where a camera saw the sole itself, with a margin.
Mask seen_sole(const Plan& plan, const PointCloud& foot, double height) {
  Mask seen(plan.cells(), 0);
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const bool sole = foot.was_seen(i) && foot.normals[i].z() < kSeenSoleNormal &&
                      foot.positions[i].z() < height + kSeenSoleHeightMm;
    if (sole) seen[plan.cell_of(foot.positions[i])] = 1;
  }
  return grown(plan, seen, 2.0 * plan.cell_mm);
}

void add_platform_point(PointCloud& cloud, const Vector2d& place, double height, double sigma_mm) {
  cloud.positions.emplace_back(place.x(), place.y(), height);
  cloud.normals.push_back(-Vector3d::UnitZ());
  cloud.sigma_mm.push_back(sigma_mm);
  cloud.view_directions.push_back(-Vector3d::UnitZ());
  cloud.origins.push_back(PointOrigin::kPlatform);
}

}  // namespace

SoleClosure close_sole(PointCloud& foot, double standing_height_mm, const SoleSettings& settings) {
  SoleClosure closure;
  if (foot.empty() || !foot.has_normals()) return closure;
  const Plan plan = Plan::round(foot, settings.spacing_mm, 2.5 * settings.bridge_mm);
  const Mask print = footprint(plan, foot, standing_height_mm, settings);
  const Mask seen = seen_sole(plan, foot, standing_height_mm);
  // Where the wall ends too unevenly to tell its rounding, at least the least inset is kept.
  Mask closing =
      inverted(grown(plan, inverted(print), settings.least_inset_mm + settings.spacing_mm));
  for (const auto& wall : wall_feet(foot, standing_height_mm, settings)) {
    const double inset = contact_distance(wall, standing_height_mm, settings);
    closure.widest_inset_mm = std::max(closure.widest_inset_mm, inset);
    clear_hollow(plan, wall, inset, closing);
  }
  PointCloud sole;
  double cells = 0.0;
  double seen_cells = 0.0;
  for (int row = 0; row < plan.rows; ++row) {
    for (int column = 0; column < plan.columns; ++column) {
      const std::size_t cell = plan.at(column, row);
      if (print[cell]) {
        cells += 1.0;
        seen_cells += seen[cell] ? 1.0 : 0.0;
      }
      if (!closing[cell] || seen[cell]) continue;
      add_platform_point(sole, plan.centre(column, row), standing_height_mm, settings.sigma_mm);
    }
  }
  foot.append(sole);
  closure.points_added = sole.size();
  closure.area_mm2 = static_cast<double>(closure.points_added) * plan.cell_mm * plan.cell_mm;
  closure.seen_share = cells > 0.0 ? seen_cells / cells : 0.0;
  return closure;
}

}  // namespace instep
