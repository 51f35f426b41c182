#include "core/fusion/frames/temporal_fusion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "core/fusion/frames/camera_limits.h"
#include "core/in_millimetres.h"
#include "core/median.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

constexpr double kNearestMm = 50.0;
constexpr double kFarthestMm = 3000.0;
constexpr double kLeastFilledShare = 0.002;  // a frame with fewer pixels in range is blind
constexpr double kLeastSeenShare = 0.4;  // of the frames, in which a pixel must be seen to count
constexpr double kGate = 3.5;  // robust deviations from the median beyond which a value is dropped
constexpr double kMovementLimitMm = 1.0;  // beyond it `moved` is set
/// Those beyond are passed over: bounds the memory.
constexpr int kMostFrames = 120;
static_assert(kMostFrames <= std::numeric_limits<std::uint8_t>::max(),
              "a pixel's values are counted");
constexpr int kBlock = 8;                 // pixels a side of a block that is watched for movement
constexpr double kDeepestBlockMm = 40.0;  // a block with more depth in it lies on a silhouette
constexpr double kMovingShare = 0.01;     // of the blocks has to move for it to count
constexpr double kSureOfMove = 5.0;       // standard deviations
constexpr double kModelFrames = 2.0;      // the sensor model weighs as much as so many frames
constexpr double kStepPerMm = 2.9e-6;     // smallest step of depth = this * Z^2, or one unit
constexpr double kCorrelatedShare = 0.1;  // of one frame's sigma: frames do not average it away

/// The values that a pixel showed, ascending.
struct Samples {
  const std::uint16_t* values;
  int count;
};

struct Estimate {
  double mean = 0.0;
  double squares = 0.0;  ///< sum of squared deviations from the mean
  int kept = 0;
};

/// Median of |value - median|, by walking outward from the middle of the sorted values.
int median_deviation(const Samples& samples) {
  const int middle = samples.count / 2;
  const int median = samples.values[middle];
  int below = middle;
  int above = middle + 1;
  int deviation = 0;
  for (int taken = 0; taken <= middle; ++taken) {
    const int down = below >= 0 ? median - samples.values[below] : 1 << 20;
    const int up = above < samples.count ? samples.values[above] - median : 1 << 20;
    deviation = std::min(down, up);
    if (down <= up) {
      --below;
    } else {
      ++above;
    }
  }
  return deviation;
}

/// Mean of the values within `gate` of the median.
Estimate gated_mean(const Samples& samples, double gate) {
  const int median = samples.values[samples.count / 2];
  int sum = 0;
  std::int64_t squares = 0;
  Estimate estimate;
  for (int i = 0; i < samples.count; ++i) {
    const int offset = samples.values[i] - median;
    if (std::abs(offset) > gate) continue;
    sum += offset;
    squares += std::int64_t{offset} * offset;
    ++estimate.kept;
  }
  const double mean = static_cast<double>(sum) / estimate.kept;
  estimate.mean = median + mean;
  estimate.squares = std::max(0.0, static_cast<double>(squares) - estimate.kept * mean * mean);
  return estimate;
}

/// Error of the mean of rounded values: noise of half a step and more hides the rounding.
double rounding_sigma(double step, double sigma) {
  const double ratio = sigma / step;
  return step / std::sqrt(12.0) *
         std::exp(-2.0 * std::numbers::pi * std::numbers::pi * ratio * ratio);
}

double sigma_of_mean(const Estimate& estimate, double unit_mm, const SensorNoise& noise) {
  const double depth = estimate.mean * unit_mm;
  const double model = noise.axial_sigma_mm(depth);
  const double seen = estimate.squares * unit_mm * unit_mm;
  const double variance =
      (kModelFrames * model * model + seen) / (kModelFrames + estimate.kept - 1);
  const double step = std::max(unit_mm, kStepPerMm * depth * depth);
  const double rounding = rounding_sigma(step, std::sqrt(variance));
  const double correlated = kCorrelatedShare * model;
  return std::sqrt(variance / estimate.kept + rounding * rounding + correlated * correlated);
}

/// Mean raw value of a block; zero where a pixel has no data or depth jumps.
float block_mean(const DepthFrame& frame, int column, int row, int lowest, int highest,
                 int deepest) {
  int sum = 0;
  int least = highest;
  int most = lowest;
  for (int y = row; y < row + kBlock; ++y) {
    for (int x = column; x < column + kBlock; ++x) {
      const int value = frame.raw[static_cast<std::size_t>(y * frame.width + x)];
      if (value < lowest || value > highest) return 0.0F;
      sum += value;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  if (most - least > deepest) return 0.0F;
  return static_cast<float>(sum) / (kBlock * kBlock);
}

/// How far a block's depth moved between two frames, in raw units.
struct BlockMove {
  double mean = 0.0;
  double noise = 0.0;  ///< of the mean, one sigma, by how the moves of its pixels scatter
};

/// Of a block that has a mean in both.
BlockMove block_move(const std::vector<std::uint16_t>& before,
                     const std::vector<std::uint16_t>& after, int width, int column, int row) {
  constexpr int kPixels = kBlock * kBlock;
  std::int64_t sum = 0;
  std::int64_t squares = 0;
  for (int y = row; y < row + kBlock; ++y) {
    for (int x = column; x < column + kBlock; ++x) {
      const auto pixel = static_cast<std::size_t>(y * width + x);
      const std::int64_t move = std::int64_t{after[pixel]} - before[pixel];
      sum += move;
      squares += move * move;
    }
  }
  BlockMove found;
  found.mean = static_cast<double>(sum) / kPixels;
  const double spread = static_cast<double>(squares) / kPixels - found.mean * found.mean;
  found.noise = std::sqrt(std::max(0.0, spread) / (kPixels - 1));
  return found;
}

}  // namespace

TemporalFusion::TemporalFusion(TemporalSettings settings) : settings_(settings) {
  settings_.expected_frames = std::max(settings_.expected_frames, 1);
}

Result<void> TemporalFusion::check(const DepthFrame& frame) const {
  const auto corrupt = [&](const std::string& what) {
    return fail(ErrorCode::kCorruptData, "a frame of camera " + frame.camera + " " + what,
                "check its cable");
  };
  if (frame.status != FrameStatus::kGood) return corrupt("came damaged");
  if (frame.width < 1 || frame.height < 1 || frame.width > kLargestImageSide ||
      frame.height > kLargestImageSide) {
    return corrupt("has no sound size");
  }
  const auto pixels =
      static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  if (frame.raw.size() != pixels) return corrupt("does not hold one value for each pixel");
  if (!is_depth_unit(frame.depth_unit_mm)) return corrupt("has no sound depth unit");
  if (frames_used_ == 0) return {};
  if (frame.width != width_ || frame.height != height_ || frame.depth_unit_mm != unit_mm_) {
    return corrupt("differs in size or unit from those before");
  }
  return {};
}

void TemporalFusion::start(const DepthFrame& frame) {
  camera_ = frame.camera;
  width_ = frame.width;
  height_ = frame.height;
  unit_mm_ = frame.depth_unit_mm;
  // 65535 is what cameras send for "too far", whatever their unit.
  const auto raw = [&](double depth_mm) {
    return static_cast<std::uint16_t>(std::clamp(depth_mm / unit_mm_, 1.0, 65534.0));
  };
  nearest_raw_ = raw(kNearestMm);
  farthest_raw_ = raw(kFarthestMm);
  counts_.assign(frame.raw.size(), 0);
}

/// Makes room for the frames that are expected, then for twice as many, as far as it can be needed.
void TemporalFusion::widen() {
  constexpr std::size_t kMost = kMostFrames;
  const auto expected = static_cast<std::size_t>(settings_.expected_frames);
  const std::size_t wider = std::min(std::max(expected, 2 * room_), kMost);
  std::vector<std::uint16_t> sorted(counts_.size() * wider);
  for (std::size_t pixel = 0; pixel < counts_.size(); ++pixel) {
    std::copy_n(sorted_.data() + pixel * room_, counts_[pixel], sorted.data() + pixel * wider);
  }
  sorted_ = std::move(sorted);
  room_ = wider;
}

Result<void> TemporalFusion::add(const DepthFrame& frame) {
  if (frames_used_ >= kMostFrames) return {};
  auto sound = check(frame);
  if (!sound) {
    ++frames_rejected_;
    return sound;
  }
  if (frames_used_ == 0) start(frame);
  const auto in_range = [&](std::uint16_t value) {
    return value >= nearest_raw_ && value <= farthest_raw_;
  };
  const auto filled = std::count_if(frame.raw.begin(), frame.raw.end(), in_range);
  if (static_cast<double>(filled) < kLeastFilledShare * static_cast<double>(frame.raw.size())) {
    ++frames_rejected_;
    return fail(ErrorCode::kInsufficientData,
                "a frame of camera " + frame.camera + " shows nearly nothing from " +
                    in_millimetres(kNearestMm) + " to " + in_millimetres(kFarthestMm) + " away",
                "check that nothing covers the camera, and its depth_unit_mm");
  }
  if (static_cast<std::size_t>(frames_used_) == room_) widen();
  for (std::size_t pixel = 0; pixel < frame.raw.size(); ++pixel) {
    const std::uint16_t value = frame.raw[pixel];
    if (!in_range(value)) continue;
    std::uint16_t* const first = sorted_.data() + pixel * room_;
    std::uint16_t* place = first + counts_[pixel]++;
    for (; place != first && *(place - 1) > value; --place) *place = *(place - 1);
    *place = value;
  }
  note_movement(frame);
  ++frames_used_;
  return {};
}

void TemporalFusion::note_movement(const DepthFrame& frame) {
  const auto deepest = static_cast<int>(kDeepestBlockMm / unit_mm_);
  std::vector<float> blocks;
  for (int y = 0; y + kBlock <= height_; y += kBlock) {
    for (int x = 0; x + kBlock <= width_; x += kBlock) {
      blocks.push_back(block_mean(frame, x, y, nearest_raw_, farthest_raw_, deepest));
    }
  }
  if (frames_used_ == 0) {
    first_raw_ = frame.raw;
    first_blocks_ = std::move(blocks);
    return;
  }
  std::vector<double> moves;
  const int columns = width_ / kBlock;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i] == 0.0F || first_blocks_[i] == 0.0F) continue;
    const auto place = std::div(static_cast<int>(i), columns);
    const BlockMove move =
        block_move(first_raw_, frame.raw, width_, place.rem * kBlock, place.quot * kBlock);
    const double told = settings_.noise.axial_sigma_mm(first_blocks_[i] * unit_mm_);
    // A camera may be noisier than its model says, and is on skin that it sees from the side.
    const double noise = std::max(std::numbers::sqrt2 * told / kBlock, move.noise * unit_mm_);
    const double moved_mm = std::abs(move.mean) * unit_mm_;
    moves.push_back(moved_mm > kSureOfMove * noise ? moved_mm : 0.0);
  }
  if (moves.empty()) return;
  const auto rank = static_cast<std::ptrdiff_t>(kMovingShare * static_cast<double>(moves.size()));
  std::nth_element(moves.begin(), moves.begin() + rank, moves.end(), std::greater<>());
  movement_mm_ = std::max(movement_mm_, moves[static_cast<std::size_t>(rank)]);
}

Result<FusedDepth> TemporalFusion::result() const {
  if (frames_used_ == 0) {
    return fail(ErrorCode::kInsufficientData, "a camera gave no usable frame",
                "check its cable and that nothing covers it, then scan again");
  }
  FusedDepth fused;
  fused.camera = camera_;
  fused.width = width_;
  fused.height = height_;
  fused.depth_mm.assign(counts_.size(), 0.0F);
  fused.sigma_mm.assign(counts_.size(), 0.0F);
  fused.frames_used = frames_used_;
  fused.frames_rejected = frames_rejected_;
  fused.movement_mm = movement_mm_;
  fused.moved = movement_mm_ > kMovementLimitMm;
  const int needed = std::max(1, static_cast<int>(std::ceil(kLeastSeenShare * frames_used_)));
  for (std::size_t pixel = 0; pixel < counts_.size(); ++pixel) {
    const Samples samples{sorted_.data() + pixel * room_, counts_[pixel]};
    if (samples.count < needed) continue;
    const double depth = samples.values[samples.count / 2] * unit_mm_;
    const double model = settings_.noise.axial_sigma_mm(depth) / unit_mm_;
    const double scatter = std::max(kSigmaInMedians * median_deviation(samples), 0.5 * model);
    const Estimate estimate = gated_mean(samples, std::max(1.0, kGate * scatter));
    if (estimate.kept < needed) continue;
    fused.depth_mm[pixel] = static_cast<float>(estimate.mean * unit_mm_);
    fused.sigma_mm[pixel] = static_cast<float>(sigma_of_mean(estimate, unit_mm_, settings_.noise));
  }
  return fused;
}

}  // namespace instep
