// Files whose faces are no triangles: their points are left.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "daemon/cloud_files/cloud_file.h"

namespace instep {
namespace {

/// All points were taken for such as belong to no face, and none was left of a cloud that was read.
TEST(DegenerateFaces, LeaveThePoints) {
  const std::string points =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 1\n100 5 0\n0 20.25 3\n-1 2 30\n";
  for (const char* face : {"3 0 2 0\n", "3 1 1 1\n", "2 0 1\n", "0\n"}) {
    const auto file = read_cloud_bytes(points + face, "a.ply", LengthUnit::kMillimetre);
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_EQ(file->cloud.size(), 4U) << face;
    EXPECT_TRUE(file->mesh.empty()) << face;
  }
  const auto file = read_cloud_bytes(points + "3 0 2 0\n", "a.ply", LengthUnit::kMillimetre);
  EXPECT_TRUE(std::any_of(file->notes.begin(), file->notes.end(), [](const auto& note) {
    return note.find("no face of the file") != std::string::npos;
  }));
}

}  // namespace
}  // namespace instep
