#include "core/surface/surface_normals.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "core/geometry/moments.h"

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

/// A bend between two cells; the flattest comes first.
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
                                    const Moments& nearby, double side) {
  auto axes = nearby.axes();
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
                         double side, std::size_t fewest)
    : grid_(points, side), points_(points.size()), middle_index_({}) {
  const std::size_t cells = grid_.cell_count();
  std::vector<Moments> moments(cells);
  middles_.assign(cells, Eigen::Vector3d::Zero());
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto members = grid_.members(cell);
    for (const auto member : members) middles_[cell] += points[member];
    middles_[cell] /= static_cast<double>(members.size());
    // Round the cell's own middle, so that bodies far from the origin lose no digits.
    for (const auto member : members) moments[cell].add(points[member] - middles_[cell]);
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    Moments round;
    grid_.each_near(cell, [&](std::size_t other) {
      round.add(moments[other], middles_[other] - middles_[cell]);
    });
    if (round.count < static_cast<double>(fewest)) {
      round = {};
      for (const auto& nearest : index.nearest(middles_[cell], fewest)) {
        round.add(points[nearest.index] - middles_[cell]);
      }
    }
    normals_.push_back(normal_across_lines(index, middles_[cell], round, side));
  }
  middle_index_ = PointIndex(middles_);
}

void CellNormals::orient_by_neighbours() {
  std::vector<double> least_bends(normals_.size(), kLargestBend);
  std::vector<Part> parts;
  const Eigen::Vector2d middle = middle_of_all();
  for (std::size_t root = 0; root < normals_.size(); ++root) {
    if (least_bends[root] == kReached) continue;
    Part part{orient_part(root, least_bends), 0.0};
    part.outward = outward_share(part.cells, middle);
    parts.push_back(std::move(part));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return std::abs(a.outward) > std::abs(b.outward);
  });
  std::vector<bool> sure(normals_.size(), false);
  for (const Part& part : parts) {
    double outward = part.outward;
    if (std::abs(outward) < kPlainlyOutward) {
      const double agreement = agreement_with(sure, part.cells);
      if (agreement != 0.0) outward = agreement;
    }
    for (const std::size_t cell : part.cells) {
      if (outward < 0.0) normals_[cell] *= -1.0;
      sure[cell] = true;
    }
  }
}

Eigen::Vector2d CellNormals::middle_of_all() const {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const auto& place : middles_) middle += place.head<2>();
  return middle / std::max(1.0, static_cast<double>(middles_.size()));
}

/// Between -1 and 1: how far the normals of some cells face away from the middle.
double CellNormals::outward_share(const std::vector<std::size_t>& cells,
                                  const Eigen::Vector2d& middle) const {
  double outward = 0.0;
  double most = 0.0;
  for (const std::size_t cell : cells) {
    const Eigen::Vector2d arm = middles_[cell].head<2>() - middle;
    outward += normals_[cell].head<2>().dot(arm);
    most += arm.norm();
  }
  return most > 0.0 ? outward / most : 0.0;
}

/// Sum of the cosines between the normals of some cells and those of their neighbours that are
/// sure.
double CellNormals::agreement_with(const std::vector<bool>& sure,
                                   const std::vector<std::size_t>& cells) const {
  double agreement = 0.0;
  std::vector<std::size_t> links;
  for (const std::size_t cell : cells) {
    find_links(cell, links);
    for (const std::size_t other : links) {
      if (sure[other]) agreement += normals_[cell].dot(normals_[other]);
    }
  }
  return agreement;
}

/// The cells round one, or where they are few its nearest ones.
void CellNormals::find_links(std::size_t cell, std::vector<std::size_t>& links) const {
  links.clear();
  grid_.each_near(cell, [&](std::size_t near) { links.push_back(near); });
  if (links.size() >= kFewestLinks) return;
  links.clear();
  for (const auto& nearest : middle_index_.nearest(middles_[cell], kNearestLinks)) {
    links.push_back(nearest.index);
  }
}

/// Turns the cells that hang together with `root`, round no sharp bend; returns them.
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
    if (normals_[bend.from].dot(normals_[bend.to]) < 0.0) normals_[bend.to] *= -1.0;
    find_links(bend.to, links);
    for (const auto next : links) {
      // Rounding could leave less than none.
      const double size = std::max(1.0 - std::abs(normals_[bend.to].dot(normals_[next])), 0.0);
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
  std::vector<Eigen::Vector3d> normals(points_);
  for (std::size_t cell = 0; cell < normals_.size(); ++cell) {
    for (const auto member : grid_.members(cell)) normals[member] = normals_[cell];
  }
  return normals;
}

}  // namespace instep
