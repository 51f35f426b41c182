#include "core/geometry/disjoint_sets.h"

#include <algorithm>
#include <numeric>

namespace instep {

DisjointSets::DisjointSets(std::size_t size) : parents_(size), count_(size) {
  std::iota(parents_.begin(), parents_.end(), std::size_t{0});
}

std::size_t DisjointSets::of(std::size_t member) {
  while (parents_[member] != member) member = parents_[member] = parents_[parents_[member]];
  return member;
}

bool DisjointSets::join(std::size_t one, std::size_t other) {
  one = of(one);
  other = of(other);
  if (one == other) return false;
  parents_[std::max(one, other)] = std::min(one, other);
  --count_;
  return true;
}

std::vector<std::size_t> DisjointSets::numbers() {
  std::vector<std::size_t> numbers(parents_.size());
  std::size_t next = 0;
  for (std::size_t member = 0; member < parents_.size(); ++member) {
    const std::size_t least = of(member);
    numbers[member] = least == member ? next++ : numbers[least];
  }
  return numbers;
}

}  // namespace instep
