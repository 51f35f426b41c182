#include "core/surface/normals/surface_facets.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/geometry/moments.h"
#include "core/geometry/moments_round.h"
#include "core/mean.h"
#include "core/median.h"

namespace instep {
namespace {

/// A cell with fewer neighbours stands in a sparse part, where others are further off.
constexpr std::size_t kFewestLinks = 7;
constexpr std::size_t kNearestLinks = 10;

/// Points that spread less than this across than along (sums of squares) are those of one line of a
/// scanner, as thick as their noise or their bend: which way it faces they do not tell, but those
/// round it that reach the next lines do. The first ones are looked for so many sides off, and
/// each time so much further.
constexpr double kThinLine = 0.15;
constexpr double kFirstRound = 2.0;
constexpr double kWidening = 1.5;
/// Further off lies another side of the body.
constexpr double kWidestRound = 0.3;

/// Points further from their plane (root mean square) than this part of a side may be those of two
/// walls, if noise does not explain it: a multiple of what is known of it, or of what a quarter of
/// all cells show at most, since few points of a thin part seem noisy.
constexpr double kThick = 0.1;
constexpr double kThickInSigmas = 2.5;
constexpr double kThickInUsual = 2.0;
constexpr double kUsual = 0.25;
/// Sine of the angle between a wall and the chord to what goes on from it, at most.
constexpr double kOffWall = 0.5;
/// Cosines that differ by less do so by rounding, as those to the two walls of a plate.
constexpr double kRounding = 1e-9;

/// Of points round a place, more and more while they all lie on one line.
Eigen::Vector3d normal_across_lines(const PointIndex& index, const Eigen::Vector3d& place,
                                    SpreadAxes axes, double side) {
  for (double radius = kFirstRound * side; are_on_a_line(axes, kThinLine) && radius < kWidestRound;
       radius *= kWidening) {
    axes = moments_round(index, place, index.around(place, radius)).axes();
  }
  return axes.eigenvectors().col(0);
}

/// Moments of points round their own middle, so that bodies far from the origin lose no digits.
struct Cluster {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Moments moments;
};

std::vector<Cluster> clusters_of(const VoxelGrid& grid,
                                 const std::vector<Eigen::Vector3d>& points) {
  std::vector<Cluster> clusters(grid.cell_count());
  for (std::size_t cell = 0; cell < clusters.size(); ++cell) {
    auto& [middle, moments] = clusters[cell];
    const auto members = grid.members(cell);
    middle = mean_of(members, [&](std::uint32_t member) { return points[member]; });
    for (const auto member : members) moments.add(points[member] - middle);
  }
  return clusters;
}

/// Of the points of a cell and those round it, or where these are fewer than `fewest` the nearest
/// ones.
Moments moments_of_block(std::size_t cell, const VoxelGrid& grid,
                         const std::vector<Cluster>& clusters, const PointIndex& index,
                         std::size_t fewest) {
  const Eigen::Vector3d& middle = clusters[cell].middle;
  Moments round;
  grid.each_near(cell, [&](std::size_t other) {
    round.add(clusters[other].moments, clusters[other].middle - middle);
  });
  if (round.count >= static_cast<double>(fewest)) return round;
  return moments_round(index, middle, index.nearest(middle, fewest));
}

}  // namespace

SurfaceFacets::SurfaceFacets(const PointIndex& index, double side, double sigma, std::size_t fewest)
    : grid_(index.points(), side), facet_of_(index.points().size()), middle_index_({}) {
  const auto& points = index.points();
  const auto clusters = clusters_of(grid_, points);
  std::vector<Look> looks(clusters.size());
  std::vector<double> thicknesses;
  for (std::size_t cell = 0; cell < clusters.size(); ++cell) {
    looks[cell].middle = clusters[cell].middle;
    const Moments round = moments_of_block(cell, grid_, clusters, index, fewest);
    const auto axes = round.axes();
    thicknesses.push_back(std::sqrt(std::max(axes.eigenvalues()[0], 0.0) / round.count));
    looks[cell].normal = normal_across_lines(index, looks[cell].middle, axes, side);
  }
  const double noise =
      std::min(kThickInSigmas * sigma, kThickInUsual * quantile(thicknesses, kUsual));
  quiet_ = noise <= kThick * side;
  for (std::size_t cell = 0; cell < looks.size(); ++cell) {
    looks[cell].is_thick = thicknesses[cell] > std::max(kThick * side, noise);
    if (looks[cell].is_thick) find_walls(points, cell, looks[cell]);
  }
  set_facets(points, looks);
}

/// Looks for walls in a thick cell and round it.
void SurfaceFacets::find_walls(const std::vector<Eigen::Vector3d>& points, std::size_t cell,
                               Look& look) const {
  std::vector<Eigen::Vector3d> round;
  std::size_t first = 0;
  grid_.each_near(cell, [&](std::size_t near) {
    if (near == cell) first = round.size();
    for (const auto member : grid_.members(near)) round.push_back(points[member]);
  });
  look.walls = OppositeWalls::among(round);
  if (!look.walls) return;
  const auto begin = look.walls->sides.begin() + static_cast<std::ptrdiff_t>(first);
  look.sides.assign(begin, begin + static_cast<std::ptrdiff_t>(grid_.members(cell).size()));
}

/// One of each cell, or two of one with walls; none of a thick one beside such: each of its points
/// is of that facet round it whose plane comes nearest.
void SurfaceFacets::set_facets(const std::vector<Eigen::Vector3d>& points,
                               const std::vector<Look>& looks) {
  std::vector<std::size_t> muddled;
  for (std::size_t cell = 0; cell < looks.size(); ++cell) {
    const Look& look = looks[cell];
    begins_.push_back(static_cast<std::uint32_t>(facets_.size()));
    const auto is_beside_walls = [&] {
      bool is_beside = false;
      grid_.each_near(cell, [&](std::size_t near) { is_beside = is_beside || looks[near].walls; });
      return is_beside;
    };
    if (look.walls) {
      add_walls(points, cell, look);
    } else if (look.is_thick && is_beside_walls()) {
      muddled.push_back(cell);
    } else {
      for (const auto member : grid_.members(cell)) facet_of_[member] = begins_.back();
      facets_.push_back({cell, look.middle, look.normal});
    }
  }
  begins_.push_back(static_cast<std::uint32_t>(facets_.size()));
  for (const auto cell : muddled) share_out(points, cell);
  std::vector<Eigen::Vector3d> middles;
  middles.reserve(facets_.size());
  for (const auto& facet : facets_) middles.push_back(facet.middle);
  middle_index_ = PointIndex(std::move(middles));
}

/// Both, even if all of the cell's own points lie on one.
void SurfaceFacets::add_walls(const std::vector<Eigen::Vector3d>& points, std::size_t cell,
                              const Look& look) {
  const auto members = grid_.members(cell);
  for (std::uint8_t side = 0; side < 2; ++side) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (look.sides[i] != side) continue;
      facet_of_[members[i]] = static_cast<std::uint32_t>(facets_.size());
      sum += points[members[i]];
      count += 1.0;
    }
    const auto& wall = look.walls->both[side];
    const Eigen::Vector3d middle = count > 0.0 ? Eigen::Vector3d(sum / count) : wall.middle;
    facets_.push_back({cell, middle, wall.normal});
  }
}

void SurfaceFacets::share_out(const std::vector<Eigen::Vector3d>& points, std::size_t cell) {
  for (const auto member : grid_.members(cell)) {
    double nearest = std::numeric_limits<double>::infinity();
    grid_.each_near(cell, [&](std::size_t near) {
      for (std::uint32_t i = begins_[near]; i < begins_[near + 1]; ++i) {
        const double off = facets_[i].off(points[member]);
        if (off >= nearest) continue;
        nearest = off;
        facet_of_[member] = i;
      }
    });
  }
}

/// Those of the cells round it, or where they are few the nearest ones.
void SurfaceFacets::find_links(std::size_t facet, std::vector<std::size_t>& links) const {
  links.clear();
  grid_.each_near(facets_[facet].cell, [&](std::size_t near) {
    for (std::uint32_t i = begins_[near]; i < begins_[near + 1]; ++i) links.push_back(i);
  });
  if (links.size() >= kFewestLinks) return;
  links.clear();
  for (const auto& nearest : middle_index_.nearest(facets_[facet].middle, kNearestLinks)) {
    links.push_back(nearest.index);
  }
}

/// Whether the skin may run from one facet on to the other, and not across a thin part: along both,
/// unless noise hides that, and to none that the wall opposite to one of them goes on to sooner.
bool SurfaceFacets::goes_on(std::size_t facet, std::size_t next) const {
  const Facet& here = facets_[facet];
  const Facet& there = facets_[next];
  const double most = kOffWall * (there.middle - here.middle).norm();
  const bool leads_along = here.off(there.middle) <= most && there.off(here.middle) <= most;
  if (quiet_ && !leads_along) return false;
  return is_wall_of(here, there) && is_wall_of(there, here);
}

/// Whether of the walls in its cell this is the one that another facet lies on and faces as.
bool SurfaceFacets::is_wall_of(const Facet& wall, const Facet& other) const {
  const auto begin = facets_.begin() + begins_[wall.cell];
  const auto end = facets_.begin() + begins_[wall.cell + 1];
  return std::none_of(begin, end, [&](const Facet& opposite) {
    const double turned = std::abs(opposite.normal.dot(other.normal));
    return opposite.off(other.middle) < wall.off(other.middle) ||
           turned > std::abs(wall.normal.dot(other.normal)) + kRounding;
  });
}

std::vector<Eigen::Vector3d> SurfaceFacets::normals_of_points() const {
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(facet_of_.size());
  for (const auto facet : facet_of_) normals.push_back(facets_[facet].normal);
  return normals;
}

}  // namespace instep
