#pragma once

#include <cstddef>
#include <string>

namespace instep {

/// A PLY with more errors than these that its points share is refused: a fusion tells a fifth of
/// them at the most.
inline constexpr std::size_t kMostSharedErrors = 100;

/// The property of PointCloud::shared_errors_mm[index]; files count from 1.
inline std::string shared_error_property(std::size_t index) {
  return "shared_error_" + std::to_string(index + 1) + "_mm";
}

}  // namespace instep
