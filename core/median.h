#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace instep {

/// The value below which that share of the others lies, `share` from 0 to 1, to the next lower one;
/// zero where there are none. Takes its own copy, as median() does. O(n).
template <typename T>
T quantile(std::vector<T> values, double share) {
  if (values.empty()) return T{};
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  const auto chosen = values.begin() + rank;
  std::nth_element(values.begin(), chosen, values.end());
  return *chosen;
}

/// The middle value, of an even number the higher of the two; zero where there are none. Takes its
/// own copy, because finding it puts the values in another order. O(n).
template <typename T>
T median(std::vector<T> values) {
  if (values.empty()) return T{};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace instep
