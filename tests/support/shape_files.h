#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/triangle_mesh.h"
#include "core/girth/tape_plane.h"

namespace instep::test {

/// A body of the trial data: its points, and its faces where the file has them.
struct ShapeFile {
  PointCloud cloud;
  TriangleMesh mesh;
};

/// Reads the binary PLY and STL files of the trial data (float32 properties x y z [nx ny nz]; an
/// STL's corners are kept as they are, three a face). Throws std::runtime_error on anything else.
ShapeFile read_shape(const std::filesystem::path& path, double unit_mm = 1.0);

/// A section of the trial data whose girth is known from elsewhere.
struct KnownSection {
  std::string file;  ///< name of the body's file, without what truth.json adds to it
  std::string name;
  TapePlane plane;
  double sigma_mm;
  double stretched_mm;
  double contact_mm;
};

/// The sections named by the truth.json of a folder of the trial data: "shapes", "feet" or "lasts".
std::vector<KnownSection> known_sections(const std::string& folder);

/// Points spread evenly at random over the faces of a mesh, `sigma_mm` off along the face's normal;
/// no normals are told.
PointCloud points_on(const TriangleMesh& mesh, std::size_t count, double sigma_mm,
                     std::uint64_t seed);

/// The same points, and each with the normal of its face.
PointCloud oriented_points_on(const TriangleMesh& mesh, std::size_t count, double sigma_mm,
                              std::uint64_t seed);

}  // namespace instep::test
