#pragma once

#include <cstddef>
#include <string>

namespace instep {

/// The property of PointCloud::shared_errors_mm[index]; files count from 1.
inline std::string shared_error_property(std::size_t index) {
  return "shared_error_" + std::to_string(index + 1) + "_mm";
}

}  // namespace instep
