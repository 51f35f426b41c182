#pragma once

#include <filesystem>
#include <string>

#include "core/geometry/triangle_mesh.h"
#include "core/result.h"

namespace instep {

/// A mesh as a binary little-endian PLY: x y z as float64, faces as lists of int32. Coordinates
/// come back bit by bit. Fails with kInvalidInput if a face names a corner that is not there, and
/// with kUnsupported for more than 2^31 - 1 corners.
Result<std::string> mesh_to_ply(const TriangleMesh& mesh);

/// The same to a file, whole or not at all.
Result<void> write_mesh_ply(const TriangleMesh& mesh, const std::filesystem::path& path);

}  // namespace instep
