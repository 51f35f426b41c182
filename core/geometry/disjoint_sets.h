#pragma once

#include <cstddef>
#include <vector>

namespace instep {

/// Which of some things hang together, as one after the other is joined (union-find). Each set goes
/// by the least of its members. Hardly more than O(1) for each call.
class DisjointSets {
 public:
  /// Each by itself.
  explicit DisjointSets(std::size_t size);

  /// The least member of the set that one is in.
  std::size_t of(std::size_t member);

  /// False if they hung together before.
  bool join(std::size_t one, std::size_t other);

  std::size_t count() const { return count_; }  ///< of sets

  /// The number of each member's set: from zero, by their least members. O(size).
  std::vector<std::size_t> numbers();

 private:
  std::vector<std::size_t> parents_;  ///< no larger than the member
  std::size_t count_;
};

}  // namespace instep
