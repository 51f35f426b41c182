#include "core/geometry/place_hash.h"

#include <algorithm>
#include <utility>

namespace instep {

std::vector<std::size_t> some_by_place(const std::vector<Eigen::Vector3d>& places_mm,
                                       std::size_t most) {
  std::vector<std::pair<std::uint64_t, std::size_t>> hashes;
  hashes.reserve(places_mm.size());
  for (const auto& place : places_mm) hashes.emplace_back(hash_of_place(place), hashes.size());
  most = std::min(most, hashes.size());
  const auto end = hashes.begin() + static_cast<std::ptrdiff_t>(most);
  std::partial_sort(hashes.begin(), end, hashes.end());
  std::vector<std::size_t> some;
  some.reserve(most);
  for (auto chosen = hashes.begin(); chosen != end; ++chosen) some.push_back(chosen->second);
  return some;
}

}  // namespace instep
