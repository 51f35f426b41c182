#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <type_traits>

namespace instep {

/// The mean of what `of` makes of each item, floating-point numbers or vectors of a fixed size
/// (none of Eigen's expressions); zero of none. Summed in their order, then divided. O(items).
template <typename Items, typename Of = std::identity>
auto mean_of(const Items& items, Of of = {}) {
  using Mean = std::decay_t<std::invoke_result_t<Of&, decltype(*std::begin(items))>>;
  Mean sum;
  if constexpr (std::is_floating_point_v<Mean>) {
    sum = 0;
  } else {
    sum.setZero();
  }
  for (const auto& item : items) sum += std::invoke(of, item);
  const auto count = static_cast<double>(std::max<std::size_t>(1, std::size(items)));
  return Mean(sum / count);
}

}  // namespace instep
