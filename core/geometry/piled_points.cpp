#include "core/geometry/piled_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>

#include "core/geometry/moments.h"
#include "core/geometry/quadratic_skin.h"
#include "core/geometry/voxel_grid.h"
#include "core/median.h"

namespace instep {
namespace {

constexpr std::size_t kDirections = 64;
constexpr double kSparser = 0.3;
/// Sparser than this, in least sides, is no skin but what strays about.
constexpr double kWidestSide = 8.0;
/// A cell of more times the usual count is a pile. Of 390 bands of lasts and feet, even, random, as
/// modelled or noisy, one has 13; where the meridians of a modelled foot meet, 20.
constexpr double kPile = 30.0;
/// A block of so many times what is usual is the foot of one.
constexpr double kFoot = 2.0;
/// Cells of a block that a level sheet meets.
constexpr double kCellsOfSheet = 9.0;
/// A cell of a smaller part of the points of the fullest one beside it is the fringe of a pile.
constexpr double kFringe = 0.5;
/// Of the variances of a block across the skin and along it.
constexpr double kFlat = 0.25;
constexpr double kMostlyFlat = 0.5;
constexpr int kMostWidenings = 2;
/// Points of a block that tell its skin.
constexpr std::size_t kEnough = 500;
/// Of a side.
constexpr double kTexture = 0.05;

/// Points for each square unit of the skin round a middle.
double usual_density(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector2d& middle,
                     double height) {
  struct Sector {
    double points = 0.0;
    double reaches = 0.0;
  };
  std::array<Sector, kDirections> sectors;
  for (const auto& point : points) {
    const Eigen::Vector2d arm = point.head<2>() - middle;
    const double turn = 0.5 + std::atan2(arm.y(), arm.x()) / (2.0 * std::numbers::pi);
    const auto number = static_cast<std::size_t>(turn * kDirections);
    Sector& sector = sectors[std::min(number, kDirections - 1)];
    sector.points += 1.0;
    sector.reaches += arm.norm();
  }
  std::vector<double> densities;
  for (const auto& sector : sectors) {
    if (!(sector.reaches > 0.0)) continue;
    const double width = 2.0 * std::numbers::pi / kDirections * sector.reaches / sector.points;
    densities.push_back(sector.points / (width * height));
  }
  return quantile(std::move(densities), kSparser);
}

/// A cell and the 26 round it.
class Block {
 public:
  Block(const VoxelGrid& grid, std::size_t cell) : grid_(grid), cell_(cell) {
    grid.each_near(cell, [&](std::size_t near) {
      count_ += grid.members(near).size();
      fullest_ = std::max(fullest_, grid.members(near).size());
    });
  }

  std::span<const std::uint32_t> members() const { return grid_.members(cell_); }

  bool is_in_pile(const PileLevel& level) const {
    return static_cast<double>(count_) > kFoot * kCellsOfSheet * level.usual;
  }
  bool is_fringe() const {
    return static_cast<double>(members().size()) < kFringe * static_cast<double>(fullest_);
  }

  /// Some of all points, evenly over their order.
  std::vector<std::uint32_t> sample() const {
    const std::size_t stride = 1 + count_ / kEnough;
    std::vector<std::uint32_t> some;
    std::size_t passed = 0;
    grid_.each_near(cell_, [&](std::size_t near) {
      for (const auto member : grid_.members(near)) {
        if (passed++ % stride == 0) some.push_back(member);
      }
    });
    return some;
  }

 private:
  const VoxelGrid& grid_;
  std::size_t cell_;
  std::size_t count_ = 0;
  std::size_t fullest_ = 0;
};

/// What the points of a block show, in sides from one of them.
class SkinOfBlock {
 public:
  SkinOfBlock(const std::vector<Eigen::Vector3d>& points, const Block& block, double side)
      : origin_(points[block.members().front()]), side_(side) {
    std::vector<Eigen::Vector3d> arms;
    for (const auto member : block.sample()) arms.push_back((points[member] - origin_) / side);
    Moments moments;
    for (const auto& arm : arms) moments.add(arm);
    middle_ = moments.middle();
    const auto axes = moments.axes();
    axes_ << axes.eigenvectors().rightCols<2>(), axes.eigenvectors().col(0);
    flat_ = axes.eigenvalues()[0] < kFlat * axes.eigenvalues()[1];
    if (!flat_) return;
    for (auto& arm : arms) arm = axes_.transpose() * (arm - middle_);
    skin_ = QuadraticSkin::through(arms, kTexture);
  }

  bool is_flat() const { return flat_; }

  /// Of a point from the skin; where none shows, from the middle of all.
  double distance(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d seen = axes_.transpose() * ((point - origin_) / side_ - middle_);
    return skin_ ? std::abs(seen.z() - skin_->at(seen.x(), seen.y())) : seen.norm();
  }

 private:
  Eigen::Vector3d origin_;
  double side_;
  Eigen::Vector3d middle_;
  Eigen::Matrix3d axes_;  ///< along the skin, and over it
  bool flat_ = false;
  std::optional<QuadraticSkin> skin_;
};

/// Whether cells are wide enough for piles to look like skin.
bool is_mostly_flat(const std::vector<Eigen::Vector3d>& points, const PileLevel& level) {
  const VoxelGrid grid(points, level.side);
  std::size_t all = 0;
  std::size_t flat = 0;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const Block block(grid, cell);
    if (!block.is_in_pile(level) || block.is_fringe()) continue;
    ++all;
    if (SkinOfBlock(points, block, level.side).is_flat()) ++flat;
  }
  return static_cast<double>(flat) >= kMostlyFlat * static_cast<double>(all);
}

bool has_pile(const std::vector<Eigen::Vector3d>& points, const PileLevel& level) {
  const VoxelGrid grid(points, level.side);
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    if (static_cast<double>(grid.members(cell).size()) > kPile * level.usual) return true;
  }
  return false;
}

}  // namespace

std::optional<PileLevel> level_beside_piles(const std::vector<Eigen::Vector3d>& points,
                                            const Eigen::Vector2d& middle, double height,
                                            double least_side) {
  const double density = usual_density(points, middle, height);
  if (!(density > 0.0)) return std::nullopt;
  const double side = std::max(least_side, 1.0 / std::sqrt(density));
  if (side > kWidestSide * least_side) return std::nullopt;
  PileLevel level{side, density * side * side};
  if (!has_pile(points, level)) return std::nullopt;
  for (int i = 0; i < kMostWidenings && !is_mostly_flat(points, level); ++i) {
    level = {2.0 * level.side, 4.0 * level.usual};
  }
  return level;
}

std::vector<bool> surplus_in_piles(const std::vector<Eigen::Vector3d>& points,
                                   const PileLevel& level, const std::vector<double>& doubts) {
  const VoxelGrid grid(points, level.side);
  std::vector<bool> surplus(points.size(), false);
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const Block block(grid, cell);
    if (!block.is_in_pile(level)) continue;
    for (const auto member : block.members()) surplus[member] = true;
    if (block.is_fringe()) continue;
    const SkinOfBlock skin(points, block, level.side);
    const auto rank = [&](std::uint32_t member) {
      return std::pair(doubts.empty() ? 0.0 : doubts[member], skin.distance(points[member]));
    };
    const auto members = block.members();
    const auto staying = std::min_element(members.begin(), members.end(),
                                          [&](auto a, auto b) { return rank(a) < rank(b); });
    surplus[*staying] = false;
  }
  return surplus;
}

}  // namespace instep
