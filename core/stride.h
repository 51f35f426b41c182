#pragma once

#include <algorithm>
#include <cstddef>

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

}  // namespace instep
