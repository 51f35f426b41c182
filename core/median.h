#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace instep {

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
