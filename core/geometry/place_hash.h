#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace instep {

/// Scatters the bits of a number over all of another.
constexpr std::uint64_t mixed_bits(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBULL;
  return bits ^ (bits >> 31U);
}

/// A number as if at random, by where a point lies and not by when it comes. By whole micrometres:
/// in its last bits a place depends on the processor.
inline std::uint64_t hash_of_place(const Eigen::Vector3d& place_mm) {
  std::uint64_t hash = 0x9E3779B97F4A7C15ULL;
  for (int axis = 0; axis < 3; ++axis) {
    hash = mixed_bits(hash + static_cast<std::uint64_t>(std::llround(1e3 * place_mm(axis))));
  }
  return hash;
}

/// The indices of all points, or of `most` at random: the same points in whatever order all come,
/// in an order of their own. O(n log n).
std::vector<std::size_t> some_by_place(const std::vector<Eigen::Vector3d>& places_mm,
                                       std::size_t most);

}  // namespace instep
