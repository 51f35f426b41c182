#include "core/geometry/piles/skin_block.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/moments.h"
#include "core/median.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

constexpr std::size_t kEnough = 4000;
/// Of the variances across the skin and along it.
constexpr double kFlat = 0.25;
/// In sides: no further off is never left out.
constexpr double kTexture = 0.05;
/// A quadratic has so many coefficients, and in the middle of evenly spread points some four times
/// the variance of their mean.
constexpr double kCoefficients = 6.0;
constexpr double kAgainstMean = 4.0;

}  // namespace

CellBlock::CellBlock(const VoxelGrid& grid, std::size_t cell) : grid_(grid), cell_(cell) {
  grid.each_near(cell, [&](std::size_t near) {
    size_ += grid.members(near).size();
    fullest_ = std::max(fullest_, grid.members(near).size());
  });
}

std::vector<std::uint32_t> CellBlock::sample() const {
  const std::size_t stride = 1 + size_ / kEnough;
  std::vector<std::uint32_t> some;
  std::size_t passed = 0;
  each([&](std::uint32_t member) {
    if (passed++ % stride == 0) some.push_back(member);
  });
  return some;
}

BlockView::BlockView(const std::vector<Eigen::Vector3d>& points, const CellBlock& block,
                     double side)
    : origin_(points[block.members().front()]), side_(side) {
  Moments moments;
  for (const auto member : block.sample()) moments.add((points[member] - origin_) / side);
  middle_ = moments.middle();
  const auto axes = moments.axes();
  axes_ << axes.eigenvectors().rightCols<2>(), axes.eigenvectors().col(0);
  is_flat_ = are_flat(axes, kFlat);
}

std::optional<BlockSkin> BlockSkin::through(const std::vector<Eigen::Vector3d>& points,
                                            const CellBlock& block, const BlockView& view) {
  SkinPatch patch;
  for (const auto member : block.sample()) patch.push_back(view.of(points[member]));
  const auto fitted = QuadraticSkin::through(patch, kTexture);
  if (!fitted) return std::nullopt;
  BlockSkin skin(*fitted);
  std::vector<double> off;
  for (const auto& seen : patch) off.push_back(skin.distance(seen));
  skin.points_ = static_cast<double>(patch.size());
  skin.scatter_ = kSigmaInMedians * median(std::move(off)) *
                  std::sqrt(skin.points_ / (skin.points_ - kCoefficients));
  return skin;
}

double BlockSkin::error() const {
  return scatter_ * std::sqrt(kAgainstMean / points_);
}

}  // namespace instep
