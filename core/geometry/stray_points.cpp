#include "core/geometry/stray_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/voxel_grid.h"
#include "core/median.h"

namespace instep {
namespace {

constexpr std::size_t kNeighbours = 8;
constexpr double kStrayRatio = 2.2;
/// A cell and those round it hold some twenty points of an even surface; a stray, more than three
/// spacings off, has fewer than this for company.
constexpr double kCellInSpacings = 1.5;
constexpr std::size_t kCompany = 10;

double own_spacing(const std::vector<PointIndex::Neighbour>& nearest) {
  const auto found = static_cast<double>(nearest.size() - 1);
  return std::sqrt(nearest.back().squared_distance * std::numbers::pi / std::max(found, 1.0));
}

/// The spacings of points, each looked for once: points that stand apart ask for the same ones.
class OwnSpacings {
 public:
  explicit OwnSpacings(const PointIndex& index)
      : index_(index), known_(index.points().size(), kUnknown) {}

  bool stands_alone(std::size_t point) {
    const auto nearest = nearest_of(point);
    const double own = known_[point] = own_spacing(nearest);
    std::vector<double> around;
    for (const auto& neighbour : nearest) {
      double& spacing = known_[neighbour.index];
      if (spacing == kUnknown) spacing = own_spacing(nearest_of(neighbour.index));
      around.push_back(spacing);
    }
    return own > kStrayRatio * median(std::move(around));
  }

 private:
  static constexpr double kUnknown = -1.0;

  std::vector<PointIndex::Neighbour> nearest_of(std::size_t point) const {
    return index_.nearest(index_.points()[point], kNeighbours + 1);
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

double usual_spacing(const PointIndex& index, std::size_t sample) {
  const auto& points = index.points();
  if (points.size() < 2 || sample == 0) return 0.0;
  std::vector<double> spacings;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / sample);
  for (std::size_t i = 0; i < points.size(); i += stride) {
    spacings.push_back(own_spacing(index.nearest(points[i], kNeighbours + 1)));
  }
  return median(std::move(spacings));
}

}  // namespace instep
