#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "daemon/cloud_files/raw_cloud.h"

namespace instep {

/// Reads the bytes of a PLY file: ASCII or binary of either byte order, properties of any type in
/// any order, unknown properties and elements passed over, polygons cut into fans of triangles.
/// Takes x y z, nx ny nz, sigma_mm, origin (0 seen, 1 platform) and the shared and local
/// errors (error_properties.h) of `vertex`, and vertex_indices or vertex_index of `face`.
///
/// Fails with kCorruptData on a header that lies, data that end early or indices out of range, and
/// with kUnsupported beyond kMostFilePoints or kMostSharedErrors. Cost: about that of copying the
/// file, for binary.
Result<RawCloud> read_ply(std::string_view bytes, const std::string& file);

}  // namespace instep
