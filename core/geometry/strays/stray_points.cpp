#include "core/geometry/strays/stray_points.h"

#include <cmath>

#include "core/geometry/point_spacing.h"
#include "core/geometry/voxel_grid.h"

namespace instep {
namespace {

constexpr double kStrayRatio = 2.2;
/// A cell and those round it hold some twenty points of an even surface; a stray, more than three
/// spacings off, has fewer than this for company.
constexpr double kCellInSpacings = 1.5;
constexpr std::size_t kCompany = 10;

/// The spacings of points, each looked for once: points that stand apart ask for the same ones.
class OwnSpacings {
 public:
  explicit OwnSpacings(const PointIndex& index)
      : index_(index), known_(index.points().size(), kUnknown) {}

  /// Whether its own spacing is far more than the median one of its neighbours and itself. Asks no
  /// more of them, nearest first, than it takes to know.
  bool stands_alone(std::size_t point) {
    const auto nearest = nearest_of(point);
    const double own = known_[point] = own_spacing(nearest);
    const double reach = std::sqrt(nearest.back().squared_distance);
    std::size_t alike = 0;
    for (const auto& [neighbour, squared_distance] : nearest) {
      // Its reach is shorter than the point's by no more than lies between the two.
      const double rest = reach - std::sqrt(squared_distance);
      if (own <= kStrayRatio * spacing_within(rest, nearest.size() - 1) ||
          own <= kStrayRatio * spacing_of(neighbour)) {
        ++alike;
      }
      if (alike > (nearest.size() - 1) / 2) return false;
    }
    return true;
  }

 private:
  static constexpr double kUnknown = -1.0;

  std::vector<PointIndex::Neighbour> nearest_of(std::size_t point) const {
    return index_.nearest(index_.points()[point], kSpacingNeighbours + 1);
  }

  double spacing_of(std::size_t point) {
    double& spacing = known_[point];
    if (spacing == kUnknown) spacing = own_spacing(nearest_of(point));
    return spacing;
  }

  const PointIndex& index_;
  std::vector<double> known_;
};

}  // namespace

std::vector<bool> stray_points(const PointIndex& index, double spacing) {
  const auto& points = index.points();
  std::vector<bool> strays(points.size(), false);
  const VoxelGrid grid(points, kCellInSpacings * spacing);
  OwnSpacings spacings(index);
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    std::size_t company = 0;
    grid.each_near(cell, [&](std::size_t other) { company += grid.members(other).size(); });
    if (company >= kCompany) continue;
    for (const auto member : grid.members(cell)) strays[member] = spacings.stands_alone(member);
  }
  return strays;
}

}  // namespace instep
