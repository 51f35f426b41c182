#include "core/surface/surface_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "core/geometry/moments.h"
#include "core/median.h"

namespace instep {
namespace {

/// A cell with fewer neighbours stands in a sparse part, where others are further off.
constexpr std::size_t kFewestLinks = 7;
constexpr std::size_t kNearestLinks = 10;

/// Across a larger bend (one less its cosine) a normal tells little of its neighbour's side; across
/// a smaller one than the second, of 8 degrees, there is no doubt.
constexpr double kLargestBend = 0.12;
constexpr double kHardlyABend = 0.01;
constexpr double kReached = -1.0;
/// A part whose normals face away from the middle by this share of what they could needs no
/// neighbours to tell its side.
constexpr double kPlainlyOutward = 0.25;
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
/// Sine of the angle between a wall and the chord to what goes on from it, at most.
constexpr double kOffWall = 0.5;

/// A bend between two facets; the flattest comes first.
struct Bend {
  double size;
  std::size_t from;
  std::size_t to;

  bool operator<(const Bend& other) const {
    return std::pair(size, to) > std::pair(other.size, other.to);
  }
};

bool is_line(const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>& axes) {
  return axes.eigenvalues()[1] < kThinLine * axes.eigenvalues()[2];
}

/// Of points round a place, more and more while they all lie on one line.
Eigen::Vector3d normal_across_lines(const PointIndex& index, const Eigen::Vector3d& place,
                                    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes,
                                    double side) {
  for (double radius = kFirstRound * side; is_line(axes) && radius < kWidestRound;
       radius *= kWidening) {
    Moments round;
    for (const auto& near : index.around(place, radius)) {
      round.add(index.points()[near.index] - place);
    }
    axes = round.axes();
  }
  return axes.eigenvectors().col(0);
}

}  // namespace

CellNormals::CellNormals(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
                         double side, double sigma, std::size_t fewest)
    : grid_(points, side), facet_of_(points.size()), middle_index_({}) {
  const std::size_t cells = grid_.cell_count();
  std::vector<Moments> moments(cells);
  std::vector<Look> looks(cells);
  std::vector<double> thicknesses;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    Eigen::Vector3d& middle = looks[cell].middle;
    const auto members = grid_.members(cell);
    for (const auto member : members) middle += points[member];
    middle /= static_cast<double>(members.size());
    // Round the cell's own middle, so that bodies far from the origin lose no digits.
    for (const auto member : members) moments[cell].add(points[member] - middle);
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    Look& look = looks[cell];
    Moments round;
    grid_.each_near(cell, [&](std::size_t other) {
      round.add(moments[other], looks[other].middle - look.middle);
    });
    if (round.count < static_cast<double>(fewest)) {
      round = {};
      for (const auto& nearest : index.nearest(look.middle, fewest)) {
        round.add(points[nearest.index] - look.middle);
      }
    }
    const auto axes = round.axes();
    thicknesses.push_back(std::sqrt(std::max(axes.eigenvalues()[0], 0.0) / round.count));
    look.normal = normal_across_lines(index, look.middle, axes, side);
  }
  const double noise =
      std::min(kThickInSigmas * sigma, kThickInUsual * quantile(thicknesses, 0.25));
  quiet_ = noise <= kThick * side;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    looks[cell].is_thick = thicknesses[cell] > std::max(kThick * side, noise);
    if (looks[cell].is_thick) find_walls(points, cell, looks[cell]);
  }
  set_facets(points, looks);
}

/// Looks for walls in a thick cell and round it.
void CellNormals::find_walls(const std::vector<Eigen::Vector3d>& points, std::size_t cell,
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
void CellNormals::set_facets(const std::vector<Eigen::Vector3d>& points,
                             const std::vector<Look>& looks) {
  std::vector<std::size_t> muddled;
  for (std::size_t cell = 0; cell < looks.size(); ++cell) {
    const Look& look = looks[cell];
    begins_.push_back(static_cast<std::uint32_t>(facets_.size()));
    bool is_beside = false;
    grid_.each_near(cell, [&](std::size_t near) { is_beside = is_beside || looks[near].walls; });
    if (look.walls) {
      add_walls(points, cell, look);
    } else if (look.is_thick && is_beside) {
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
void CellNormals::add_walls(const std::vector<Eigen::Vector3d>& points, std::size_t cell,
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
    const auto& wall = look.walls->walls[side];
    const Eigen::Vector3d middle = count > 0.0 ? Eigen::Vector3d(sum / count) : wall.middle;
    facets_.push_back({cell, middle, wall.normal});
  }
}

void CellNormals::share_out(const std::vector<Eigen::Vector3d>& points, std::size_t cell) {
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

void CellNormals::orient_by_neighbours() {
  std::vector<double> least_bends(facets_.size(), kLargestBend);
  std::vector<Part> parts;
  const Eigen::Vector2d middle = middle_of_all();
  for (std::size_t root = 0; root < facets_.size(); ++root) {
    if (least_bends[root] == kReached) continue;
    Part part{orient_part(root, least_bends), 0.0};
    part.outward = outward_share(part.facets, middle);
    parts.push_back(std::move(part));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return std::abs(a.outward) > std::abs(b.outward);
  });
  std::vector<bool> sure(facets_.size(), false);
  for (const Part& part : parts) {
    double outward = part.outward;
    if (std::abs(outward) < kPlainlyOutward) {
      const double agreement = agreement_with(sure, part.facets);
      if (agreement != 0.0) outward = agreement;
    }
    for (const std::size_t facet : part.facets) {
      if (outward < 0.0) facets_[facet].normal *= -1.0;
      sure[facet] = true;
    }
  }
}

Eigen::Vector2d CellNormals::middle_of_all() const {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const auto& facet : facets_) middle += facet.middle.head<2>();
  return middle / std::max(1.0, static_cast<double>(facets_.size()));
}

/// Between -1 and 1: how far the normals of some facets face away from the middle.
double CellNormals::outward_share(const std::vector<std::size_t>& facets,
                                  const Eigen::Vector2d& middle) const {
  double outward = 0.0;
  double most = 0.0;
  for (const std::size_t facet : facets) {
    const Eigen::Vector2d arm = facets_[facet].middle.head<2>() - middle;
    outward += facets_[facet].normal.head<2>().dot(arm);
    most += arm.norm();
  }
  return most > 0.0 ? outward / most : 0.0;
}

/// Sum of the cosines between the normals of some facets and those of their neighbours that are
/// sure.
double CellNormals::agreement_with(const std::vector<bool>& sure,
                                   const std::vector<std::size_t>& facets) const {
  double agreement = 0.0;
  std::vector<std::size_t> links;
  for (const std::size_t facet : facets) {
    find_links(facet, links);
    for (const std::size_t other : links) {
      if (sure[other]) agreement += facets_[facet].normal.dot(facets_[other].normal);
    }
  }
  return agreement;
}

/// Those of the cells round it, or where they are few the nearest ones; of two walls only the one
/// that goes on from it.
void CellNormals::find_links(std::size_t facet, std::vector<std::size_t>& links) const {
  links.clear();
  const std::size_t cell = facets_[facet].cell;
  grid_.each_near(cell, [&](std::size_t near) {
    for (std::uint32_t i = begins_[near]; i < begins_[near + 1]; ++i) {
      if (goes_on(facet, i)) links.push_back(i);
    }
  });
  if (links.size() >= kFewestLinks) return;
  links.clear();
  for (const auto& nearest : middle_index_.nearest(facets_[facet].middle, kNearestLinks)) {
    if (goes_on(facet, nearest.index)) links.push_back(nearest.index);
  }
}

/// Whether the skin may run from one facet on to the other, and not across a thin part: along both,
/// unless noise hides that, and to none that the wall opposite to one of them goes on to sooner.
bool CellNormals::goes_on(std::size_t facet, std::size_t next) const {
  const Facet& here = facets_[facet];
  const Facet& there = facets_[next];
  const double most = kOffWall * (there.middle - here.middle).norm();
  const bool leads_along = here.off(there.middle) <= most && there.off(here.middle) <= most;
  if (quiet_ && !leads_along) return false;
  return is_wall_of(here, there) && is_wall_of(there, here);
}

/// Whether of the walls in its cell this is the one that another facet lies on and faces as.
bool CellNormals::is_wall_of(const Facet& wall, const Facet& other) const {
  const auto begin = facets_.begin() + begins_[wall.cell];
  const auto end = facets_.begin() + begins_[wall.cell + 1];
  return std::none_of(begin, end, [&](const Facet& opposite) {
    return opposite.off(other.middle) < wall.off(other.middle) ||
           std::abs(opposite.normal.dot(other.normal)) > std::abs(wall.normal.dot(other.normal));
  });
}

/// Turns the facets that hang together with `root`, round no sharp bend; returns them.
/// `least_bends`: to each cell from those reached so far.
std::vector<std::size_t> CellNormals::orient_part(std::size_t root,
                                                  std::vector<double>& least_bends) {
  std::vector<std::size_t> part;
  std::vector<std::size_t> links;
  std::priority_queue<Bend> bends;
  std::vector<Bend> flat;  // those that hardly bend wait for no other
  flat.push_back({0.0, root, root});
  while (!flat.empty() || !bends.empty()) {
    const Bend bend = flat.empty() ? bends.top() : flat.back();
    flat.empty() ? bends.pop() : flat.pop_back();
    if (least_bends[bend.to] == kReached) continue;
    least_bends[bend.to] = kReached;
    part.push_back(bend.to);
    if (facets_[bend.from].normal.dot(facets_[bend.to].normal) < 0.0) {
      facets_[bend.to].normal *= -1.0;
    };
    find_links(bend.to, links);
    for (const auto next : links) {
      // Rounding could leave less than none.
      const double cosine = facets_[bend.to].normal.dot(facets_[next].normal);
      const double size = std::max(1.0 - std::abs(cosine), 0.0);
      if (!(size < least_bends[next])) continue;
      least_bends[next] = size < kHardlyABend ? 0.0 : size;
      if (size < kHardlyABend) {
        flat.push_back({size, bend.to, next});
      } else {
        bends.push({size, bend.to, next});
      }
    }
  }
  return part;
}

std::vector<Eigen::Vector3d> CellNormals::of_points() const {
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(facet_of_.size());
  for (const auto facet : facet_of_) normals.push_back(facets_[facet].normal);
  return normals;
}

}  // namespace instep
