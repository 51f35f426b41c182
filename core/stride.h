#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace instep {

/// The step that goes evenly through a list of `count` and meets `most` > 0 of them at most, but
/// more than half of that unless it meets all.
inline std::size_t stride_to_at_most(std::size_t most, std::size_t count) {
  return std::max<std::size_t>(1, (count + most - 1) / most);
}

/// The step that meets `fewest` > 0 of them at least, and fewer than twice as many, or all.
inline std::size_t stride_to_at_least(std::size_t fewest, std::size_t count) {
  return std::max<std::size_t>(1, count / fewest);
}

/// One in `stride` > 0 of the items, the first of them included, in their order.
template <typename T>
std::vector<T> one_in(std::size_t stride, const std::vector<T>& items) {
  std::vector<T> some;
  for (std::size_t i = 0; i < items.size(); i += stride) some.push_back(items[i]);
  return some;
}

}  // namespace instep
