#include "daemon/page/silhouette.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr int kPasses = 3;
/// Each pass takes a cell, and the outline stays clear of the rim.
constexpr int kRim = kPasses + 1;
/// What three smoothings by 1-2-1 make of the last cell of a straight edge.
constexpr double kLevel = (20.0 + 15.0 + 6.0 + 1.0) / 64.0;

/// Shares of cells that are covered, smoothed.
class Coverage {
 public:
  explicit Coverage(const std::vector<GridCell>& cells) {
    first_ = last_ = cells.front();
    for (const auto& [row, column] : cells) {
      first_ = {std::min(first_.first, row), std::min(first_.second, column)};
      last_ = {std::max(last_.first, row), std::max(last_.second, column)};
    }
    first_ = {first_.first - kRim, first_.second - kRim};
    last_ = {last_.first + kRim, last_.second + kRim};
    width_ = static_cast<std::size_t>(last_.second - first_.second + 1);
    share_.assign(width_ * static_cast<std::size_t>(last_.first - first_.first + 1), 0.0);
    for (const auto& [row, column] : cells) share_[index(row, column)] = 1.0;
    for (int pass = 0; pass < kPasses; ++pass) {
      smooth(1);
      smooth(width_);
    }
  }

  GridCell first() const { return first_; }
  GridCell last() const { return last_; }
  double above_level(int row, int column) const { return share_[index(row, column)] - kLevel; }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row - first_.first) * width_ +
           static_cast<std::size_t>(column - first_.second);
  }

  void smooth(std::size_t stride) {
    const auto before = share_;
    for (std::size_t i = stride; i + stride < share_.size(); ++i) {
      share_[i] = (before[i - stride] + 2.0 * before[i] + before[i + stride]) / 4.0;
    }
  }

  GridCell first_;
  GridCell last_;
  std::size_t width_ = 0;
  std::vector<double> share_;
};

/// An edge between two neighbouring nodes: its first node, and whether it runs along the row.
struct Edge {
  GridCell node;
  bool along_row = false;
  auto operator<=>(const Edge&) const = default;
};

Vector2d crossing(const Coverage& coverage, const Edge& edge) {
  const auto [row, column] = edge.node;
  const double here = coverage.above_level(row, column);
  const double there = edge.along_row ? coverage.above_level(row, column + 1)
                                      : coverage.above_level(row + 1, column);
  const double share = here / (here - there);
  return edge.along_row ? Vector2d(column + share, row) : Vector2d(column, row + share);
}

/// Marching squares: the pieces of outline in a square, each from edge to edge with the body on one
/// and the same side. Where two corners face each other, the body is taken apart.
void add_pieces(const Coverage& coverage, const GridCell& node, std::map<Edge, Edge>& next) {
  const auto [row, column] = node;
  // Round the square: corners, and the edge from each to the one after.
  const std::array<bool, 4> inside = {
      coverage.above_level(row, column) > 0.0, coverage.above_level(row, column + 1) > 0.0,
      coverage.above_level(row + 1, column + 1) > 0.0, coverage.above_level(row + 1, column) > 0.0};
  const std::array<Edge, 4> edges = {{{{row, column}, true},
                                      {{row, column + 1}, false},
                                      {{row + 1, column}, true},
                                      {{row, column}, false}}};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    // A piece begins where the walk round the square enters the body, and ends where it leaves it.
    if (inside[corner] || !inside[(corner + 1) % 4]) continue;
    std::size_t end = (corner + 1) % 4;
    while (inside[(end + 1) % 4]) end = (end + 1) % 4;
    next[edges[corner]] = edges[end];
  }
}

}  // namespace

std::vector<std::vector<Vector2d>> silhouette(const std::vector<GridCell>& cells) {
  if (cells.empty()) return {};
  const Coverage coverage(cells);
  std::map<Edge, Edge> next;
  for (int row = coverage.first().first; row < coverage.last().first; ++row) {
    for (int column = coverage.first().second; column < coverage.last().second; ++column) {
      add_pieces(coverage, {row, column}, next);
    }
  }
  std::vector<std::vector<Vector2d>> outlines;
  while (!next.empty()) {
    std::vector<Vector2d> outline;
    for (auto piece = next.begin(); piece != next.end();) {
      outline.push_back(crossing(coverage, piece->first));
      const Edge end = piece->second;
      next.erase(piece);
      piece = next.find(end);
    }
    if (outline.size() >= 3) outlines.push_back(std::move(outline));
  }
  return outlines;
}

}  // namespace instep
