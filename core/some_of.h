#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <random>
#include <vector>

namespace instep {

/// Numbers below `count`, ascending: all, or `most` of them at random, always the same. A stride
/// would take whole lines out of a list that was written line by line. O(count).
inline std::vector<std::size_t> some_of(std::size_t count, std::size_t most) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (count <= most) return all;
  std::vector<std::size_t> some;
  some.reserve(most);
  std::mt19937_64 random(1);
  std::sample(all.begin(), all.end(), std::back_inserter(some), most, random);
  return some;
}

}  // namespace instep
