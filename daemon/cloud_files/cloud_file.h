#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/triangle_mesh.h"
#include "core/result.h"
#include "daemon/cloud_files/length_unit.h"

namespace instep {

/// A cloud or mesh out of a file, in millimetres.
struct CloudFile {
  /// Passed check_cloud(). Of a mesh: its corners and, where faces are large, points on them, so
  /// that no stretch of surface wider than 3 mm is without a point; with outward normals if the
  /// faces are wound consistently.
  PointCloud cloud;
  TriangleMesh mesh;                          ///< the faces as in the file; empty if it has none
  std::string format;                         ///< such as "PLY, binary little endian"
  LengthUnit unit = LengthUnit::kMillimetre;  ///< in which the file was read; never kAuto
  std::vector<std::string> notes;             ///< what the user should know, sentences
};

/// Reads PLY (ASCII, binary of both byte orders), XYZ or CSV text, PCD (ASCII, binary, compressed),
/// OBJ and STL. The content decides, then the extension. sigma_mm and shared errors are taken from
/// PLY and always mean millimetres. Points without coordinates are left out, with a note
/// (leave_out_unseen()).
///
/// Every fault is an error with its file's name and advice: files that are missing, empty, cut
/// short or lie about their size (kCorruptData), many numbers that are absurd (kInvalidInput),
/// formats not handled (kUnsupported), no points (kInsufficientData), a unit that makes no sense
/// (kInvalidInput). Files up to 4 GiB and 50 million points. Nothing is allocated on the word of a
/// header alone.
Result<CloudFile> read_cloud_file(const std::filesystem::path& path, LengthUnit unit);

/// The same out of the bytes of a file; `name` gives the extension, and stands in messages.
Result<CloudFile> read_cloud_bytes(std::string_view bytes, const std::filesystem::path& name,
                                   LengthUnit unit);

}  // namespace instep
