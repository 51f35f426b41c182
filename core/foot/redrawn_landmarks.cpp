#include "core/foot/redrawn_landmarks.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kPairs = 4;

/// Student's 97.5 % points for 1 to 8 degrees of freedom.
constexpr std::array<double, 8> kStudent{12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36, 2.31};

std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBULL;
  return bits ^ (bits >> 31U);
}

/// One bit for each way of halving.
std::uint64_t hash_of(const Vector3d& point) {
  std::uint64_t hash = 0x9E3779B97F4A7C15ULL;
  for (int axis = 0; axis < 3; ++axis) {
    hash = mixed(hash + std::bit_cast<std::uint64_t>(point(axis)));
  }
  return hash;
}

RedrawnLandmarks redrawn_on(const FootScan& foot, const std::vector<std::size_t>& indices) {
  FootScan half;
  half.side = foot.side;
  half.is_floor_known = foot.is_floor_known;
  half.cloud = foot.cloud.subset(indices);
  half.landmarks = foot.landmarks;
  realign(half);
  mark(half);
  return {std::move(half.landmarks), half.foot_from_input.inverse()};
}

}  // namespace

std::vector<RedrawnLandmarks> redraw_landmarks(const FootScan& foot) {
  std::vector<std::uint64_t> hashes;
  hashes.reserve(foot.cloud.size());
  for (const auto& point : foot.cloud.positions) hashes.push_back(hash_of(point));
  std::vector<RedrawnLandmarks> redrawn;
  for (std::size_t pair = 0; pair < kPairs; ++pair) {
    for (const std::uint64_t side : {0U, 1U}) {
      std::vector<std::size_t> half;
      for (std::size_t i = 0; i < hashes.size(); ++i) {
        if (((hashes[i] >> pair) & 1U) == side) half.push_back(i);
      }
      redrawn.push_back(redrawn_on(foot, half));
    }
  }
  return redrawn;
}

std::optional<double> u95_of_halves(const std::vector<std::optional<double>>& values) {
  double sum = 0.0;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    if (!values[i] || !values[i + 1]) continue;
    sum += std::pow(*values[i] - *values[i + 1], 2) / 4.0;
    ++pairs;
  }
  if (pairs < 2) return std::nullopt;
  const double student = kStudent[std::min(pairs, kStudent.size()) - 1];
  return student * std::sqrt(sum / static_cast<double>(pairs));
}

void set_radii(FootScan& foot) {
  for (auto& [name, landmark] : foot.landmarks) {
    double squared = 0.0;
    bool is_known = true;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::optional<double>> values;
      for (const auto& redrawn : foot.redrawn) {
        const auto found = redrawn.landmarks.find(name);
        values.push_back(
            found == redrawn.landmarks.end()
                ? std::nullopt
                : std::optional((redrawn.foot_from_redrawn * found->second.position_mm)(axis)));
      }
      const auto own = u95_of_halves(values);
      is_known = is_known && own.has_value();
      squared += std::pow(own.value_or(0.0), 2);
    }
    if (is_known) landmark.radius_mm = std::sqrt(squared);
  }
}

}  // namespace instep
