#include "core/girth/contour/contour_index.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

namespace instep {
namespace {

/// Of cells across the contour, so that few corners share one, and few hold none between those that
/// do. With fewer than two the squares round a cell would not be looked at.
constexpr std::size_t kCornersForACell = 6;
constexpr std::size_t kFewestCells = 2;
constexpr std::size_t kMostCells = 64;

}  // namespace

ContourIndex::ContourIndex(std::vector<Eigen::Vector2d> corners)
    : corners_(std::move(corners)),
      ways_{0.0},
      cells_(static_cast<int>(
          std::clamp(corners_.size() / kCornersForACell, kFewestCells, kMostCells))) {
  Eigen::AlignedBox2d box;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const auto& next = corners_[(i + 1) % corners_.size()];
    ways_.push_back(ways_.back() + (next - corners_[i]).norm());
    box.extend(corners_[i]);
  }
  origin_ = box.min();
  side_ = std::max(box.sizes().maxCoeff() / cells_, std::numeric_limits<double>::min());

  begins_.assign(number_of(cells_, 0) + 1, 0);
  const auto cell_number = [&](const Eigen::Vector2d& corner) {
    const Cell cell = cell_of(corner);
    return number_of(cell.x(), cell.y());
  };
  for (const auto& corner : corners_) ++begins_[cell_number(corner) + 1];
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  members_.resize(corners_.size());
  auto ends = begins_;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    members_[ends[cell_number(corners_[i])]++] = static_cast<std::uint32_t>(i);
  }
}

std::size_t ContourIndex::number_of(int column, int row) const {
  return static_cast<std::size_t>(column * cells_ + row);
}

/// Points beyond the cells belong to the nearest one.
ContourIndex::Cell ContourIndex::cell_of(const Eigen::Vector2d& point) const {
  const Eigen::Array2d cell = (point - origin_).array() / side_;
  return cell.max(0.0).min(cells_ - 1.0).cast<int>();
}

/// Looks at the cells in squares round the point's own, until none further out can hold a nearer
/// corner. Cells of one column follow each other.
std::size_t ContourIndex::nearest_corner(const Eigen::Vector2d& point) const {
  const Cell middle = cell_of(point);
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](int column, int from_row, int to_row) {
    const std::uint32_t end = begins_[number_of(column, to_row) + 1];
    for (std::uint32_t at = begins_[number_of(column, from_row)]; at < end; ++at) {
      const double squared = (corners_[members_[at]] - point).squaredNorm();
      if (squared > least || (squared == least && members_[at] > nearest)) continue;
      least = squared;
      nearest = members_[at];
    }
  };
  for (int ring = 1; ring < cells_; ++ring) {
    const double looked_at = (ring - 1) * side_;
    if (least < looked_at * looked_at) break;
    const Cell from = (middle - ring).max(0);
    const Cell to = (middle + ring).min(cells_ - 1);
    for (int column = from.x(); column <= to.x(); ++column) {
      if (ring == 1 || std::abs(column - middle.x()) == ring) {
        look_at(column, from.y(), to.y());
        continue;
      }
      if (middle.y() - ring >= 0) look_at(column, from.y(), from.y());
      if (middle.y() + ring < cells_) look_at(column, to.y(), to.y());
    }
  }
  return nearest;
}

ContourIndex::Foot ContourIndex::foot_of(const Eigen::Vector2d& point) const {
  const std::size_t count = corners_.size();
  const std::size_t nearest = nearest_corner(point);
  Foot best{(corners_[nearest] - point).norm(), ways_[nearest]};
  for (const std::size_t from : {(nearest + count - 1) % count, nearest}) {
    const double length = ways_[from + 1] - ways_[from];
    if (!(length > 0.0)) continue;
    const Eigen::Vector2d start = corners_[from];
    const Eigen::Vector2d along = (corners_[(from + 1) % count] - start) / length;
    const double part = std::clamp(along.dot(point - start), 0.0, length);
    const double distance = (start + part * along - point).norm();
    if (distance < best.distance) best = {distance, ways_[from] + part};
  }
  return best;
}

/// Looks at the point's own cell and at those that follow and precede it in its column before it
/// looks for the nearest corner.
bool ContourIndex::passes_within(double distance, const Eigen::Vector2d& point) const {
  const Cell cell = cell_of(point);
  const std::size_t from = number_of(cell.x(), std::max(cell.y() - 1, 0));
  const std::size_t to = number_of(cell.x(), std::min(cell.y() + 1, cells_ - 1));
  for (std::uint32_t at = begins_[from]; at < begins_[to + 1]; ++at) {
    if ((corners_[members_[at]] - point).norm() <= distance) return true;
  }
  return foot_of(point).distance <= distance;
}

}  // namespace instep
