#include "daemon/cloud_files/mesh_ply_writer.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "daemon/cloud_files/little_endian.h"
#include "drivers/files/file_bytes.h"

namespace instep {
namespace {

std::string header_of(const TriangleMesh& mesh) {
  return "ply\nformat binary_little_endian 1.0\ncomment unit mm\nelement vertex " +
         std::to_string(mesh.positions.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

Result<void> check_corners(const TriangleMesh& mesh) {
  if (mesh.positions.size() > std::numeric_limits<std::int32_t>::max()) {
    return fail(ErrorCode::kUnsupported, "the mesh has more corners than a PLY file can number",
                "make a coarser one");
  }
  for (const auto& corners : mesh.triangles) {
    if (*std::max_element(corners.begin(), corners.end()) >= mesh.positions.size()) {
      return fail(ErrorCode::kInvalidInput, "a face of the mesh names a corner that is not there",
                  "report this");
    }
  }
  return {};
}

}  // namespace

Result<std::string> mesh_to_ply(const TriangleMesh& mesh) {
  if (auto sound = check_corners(mesh); !sound) return tl::make_unexpected(sound.error());
  std::string bytes = header_of(mesh);
  bytes.reserve(bytes.size() + 24 * mesh.positions.size() + 13 * mesh.triangles.size());
  for (const auto& position : mesh.positions) {
    for (const double coordinate : position) append_little_endian(bytes, coordinate);
  }
  for (const auto& corners : mesh.triangles) {
    append_little_endian(bytes, std::uint8_t{3});
    for (const auto corner : corners) {
      append_little_endian(bytes, static_cast<std::int32_t>(corner));
    }
  }
  return bytes;
}

Result<void> write_mesh_ply(const TriangleMesh& mesh, const std::filesystem::path& path) {
  const auto bytes = mesh_to_ply(mesh);
  if (!bytes) return tl::make_unexpected(bytes.error());
  return write_file_bytes(path, *bytes);
}

}  // namespace instep
