#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/result.h"

namespace instep {

/// What a reader of one format takes out of a file: the numbers as they stand, in the file's unit,
/// not yet checked. Triangle indices are valid.
struct RawCloud {
  PointCloud cloud;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::string format;
  bool are_normals_guessed = false;  ///< from columns that nobody named
  std::size_t surplus_bytes = 0;     ///< after all that its header names, without blanks at the end
  std::vector<std::string> notes;    ///< of what was passed over
};

/// More points or faces than these are refused.
inline constexpr std::size_t kMostFilePoints = 50000000;

/// The failure of a file whose content contradicts itself.
tl::unexpected<Error> damaged_file(const std::string& file, const std::string& what);

}  // namespace instep
