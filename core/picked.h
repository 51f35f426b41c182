#pragma once

#include <vector>

namespace instep {

/// Those of the items that the numbers name, in the order of these; none of an empty list, whatever
/// they name. O(numbers).
template <typename T, typename Number>
std::vector<T> picked(const std::vector<T>& items, const std::vector<Number>& numbers) {
  std::vector<T> chosen;
  if (items.empty()) return chosen;
  chosen.reserve(numbers.size());
  for (const Number number : numbers) chosen.push_back(items[number]);
  return chosen;
}

}  // namespace instep
