#include "core/geometry/piles/piled_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/geometry/near_copies.h"
#include "core/geometry/piles/pile_shadow.h"
#include "core/geometry/piles/skin_block.h"
#include "core/geometry/voxel_grid.h"

namespace instep {
namespace {

/// A column of so many times the usual count is of a pile.
constexpr double kFull = 2.0;
/// One of this part of the fullest one's is: beside it points may be the pile's, with all their
/// noise.
constexpr double kThick = 0.2;
/// Of what usual points are apart.
constexpr double kTooNear = 0.75;
/// The blocks of nine cells beside each other, and so the points of them, share their errors.
constexpr double kShared = 3.0;
/// Of a side: exact points are not known to the last digit either.
constexpr double kLeastError = 1e-4;
/// From the middle of a block, in sides: no point of it is further off.
constexpr double kReach = 3.0 * 1.7321;

/// A point that may stay.
struct Candidate {
  std::uint32_t point;
  std::size_t company;  ///< points that it stands for
  double error;
};

/// What a column of a block holds, and the best of it.
struct Column {
  std::size_t count = 0;
  std::uint32_t best = 0;
  std::pair<double, double> rank;  ///< what is to be as little as possible, the first first

  void add(std::uint32_t member, const std::pair<double, double>& rank_of_member) {
    if (count++ > 0 && !(rank_of_member < rank)) return;
    best = member;
    rank = rank_of_member;
  }
};

/// The columns of a block, on a square grid along its skin.
class Columns {
 public:
  explicit Columns(double in_side)
      : in_side_(in_side),
        in_row_(static_cast<std::size_t>(std::ceil(2.0 * kReach * in_side))),
        columns_(in_row_ * in_row_) {}

  /// `seen`: as the block's view sees a point of it.
  Column& at(const Eigen::Vector3d& seen) {
    return columns_[number(seen.x()) * in_row_ + number(seen.y())];
  }

  std::size_t fullest() const {
    return std::max_element(columns_.begin(), columns_.end(),
                            [](const auto& a, const auto& b) { return a.count < b.count; })
        ->count;
  }

  /// Whether one of the columns round it holds more.
  bool is_beside(const Eigen::Vector3d& seen, double more) const {
    const std::size_t x = number(seen.x());
    const std::size_t y = number(seen.y());
    for (std::size_t row = x - std::min<std::size_t>(x, 1); row < std::min(x + 2, in_row_); ++row) {
      for (std::size_t i = y - std::min<std::size_t>(y, 1); i < std::min(y + 2, in_row_); ++i) {
        if (static_cast<double>(columns_[row * in_row_ + i].count) > more) return true;
      }
    }
    return false;
  }

 private:
  std::size_t number(double along) const {
    const double column = std::max(0.0, (along + kReach) * in_side_);
    return std::min(in_row_ - 1, static_cast<std::size_t>(column));
  }

  double in_side_;
  std::size_t in_row_;
  std::vector<Column> columns_;
};

/// Collects what may stay of piles, cell by cell.
class Leveller {
 public:
  Leveller(const std::vector<Eigen::Vector3d>& points, const PileLevel& level,
           const std::vector<double>& doubts)
      : points_(points),
        level_(level),
        doubts_(doubts),
        columns_in_side_(std::max(1.0, std::floor(std::sqrt(level.usual)))) {}

  void add(const CellBlock& block) {
    const BlockView view(points_, block, level_.side);
    const auto skin = view.is_flat() ? BlockSkin::through(points_, block, view) : std::nullopt;
    if (skin) {
      add_skin(block, view, *skin);
    } else if (!view.is_flat() || level_.is_crowded(block.members().size())) {
      add_heap(block, view);
    } else {
      // Beside a spot so tight that it shows no skin.
      for (const auto member : block.members()) candidates_.push_back({member, 1, 0.0});
    }
  }

  const std::vector<PileFace>& faces() const { return faces_; }

  /// But for those too near to one that stands for more: what is left of their noise would be a
  /// steep slope between the two.
  std::vector<Candidate> chosen() && {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const auto& a, const auto& b) { return a.company > b.company; });
    std::vector<Eigen::Vector3d> places;
    for (const auto& one : candidates_) places.push_back(points_[one.point]);
    const auto too_near = near_copies(places, kTooNear * level_.side / columns_in_side_);
    std::vector<Candidate> chosen;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (!too_near[i]) chosen.push_back(candidates_[i]);
    }
    return chosen;
  }

 private:
  double doubt_of(std::uint32_t member) const { return doubts_.empty() ? 0.0 : doubts_[member]; }

  void add_heap(const CellBlock& block, const BlockView& view) {
    if (block.is_fringe()) return;
    Column heap;
    for (const auto member : block.members()) {
      heap.add(member, {doubt_of(member), view.of(points_[member]).norm()});
    }
    const double error = std::max(kLeastError, heap.rank.second);
    candidates_.push_back({heap.best, heap.count, error * level_.side});
  }

  void add_skin(const CellBlock& block, const BlockView& view, const BlockSkin& skin) {
    Columns columns(columns_in_side_);
    block.each([&](std::uint32_t member) {
      const Eigen::Vector3d seen = view.of(points_[member]);
      columns.at(seen).add(member, {doubt_of(member), skin.distance(seen)});
    });
    const double most = kFull * level_.usual / (columns_in_side_ * columns_in_side_);
    const double of_pile = std::max(most, kThick * static_cast<double>(columns.fullest()));
    bool is_full = false;
    for (const auto member : block.members()) {
      const Eigen::Vector3d seen = view.of(points_[member]);
      const Column& column = columns.at(seen);
      if (static_cast<double>(column.count) > most) {
        is_full = true;
        const double error =
            std::max(kLeastError, std::hypot(kShared * skin.error(), column.rank.second));
        if (column.best == member)
          candidates_.push_back({member, column.count, error * level_.side});
      } else if (!columns.is_beside(seen, of_pile)) {
        candidates_.push_back({member, 1, 0.0});
      }
    }
    if (!is_full || block.is_fringe()) return;
    faces_.push_back({points_[block.members().front()], view.normal()});
  }

  const std::vector<Eigen::Vector3d>& points_;
  const PileLevel& level_;
  const std::vector<double>& doubts_;
  double columns_in_side_;
  std::vector<Candidate> candidates_;
  std::vector<PileFace> faces_;
};

}  // namespace

LevelledPoints levelled(const std::vector<Eigen::Vector3d>& points, const PileLevel& level,
                        const std::vector<double>& doubts) {
  const VoxelGrid grid(points, level.side);
  LevelledPoints result{std::vector<bool>(points.size(), false),
                        std::vector<double>(points.size(), 0.0)};
  Leveller leveller(points, level, doubts);
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const CellBlock block(grid, cell);
    if (!level.is_beside_pile(block)) continue;
    for (const auto member : block.members()) result.surplus[member] = true;
    leveller.add(block);
  }
  mark_shadows(points, leveller.faces(), level, result.surplus);
  for (const auto& one : std::move(leveller).chosen()) {
    result.surplus[one.point] = false;
    result.errors[one.point] = one.error;
  }
  return result;
}

}  // namespace instep
