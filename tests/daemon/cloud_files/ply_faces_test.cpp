// Faces of PLY files that are not where, or not what, most programs write.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "daemon/cloud_files/cloud_file.h"

namespace instep {
namespace {

const std::string kFaceHeader = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kPointHeader =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPoints = "0 0 0\n100 0 0\n0 100 0\n";

std::string ascii(const std::string& header, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

Result<CloudFile> read(const std::string& bytes) {
  return read_cloud_bytes(bytes, "a.ply", LengthUnit::kMillimetre);
}

bool tells(const CloudFile& file, const std::string& said) {
  return std::any_of(file.notes.begin(), file.notes.end(),
                     [&](const auto& note) { return note.find(said) != note.npos; });
}

TEST(PlyFaces, AreReadBeforeTheirVertices) {
  const auto file = read(ascii(kFaceHeader + kPointHeader, "3 0 1 2\n" + kPoints));
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->mesh.triangles.size(), 1U);
}

TEST(PlyFaces, BeforeTheirVerticesNameOnlyThoseThatCome) {
  const auto file = read(ascii(kFaceHeader + kPointHeader, "3 0 1 3\n" + kPoints));
  ASSERT_FALSE(file);
  EXPECT_NE(file.error().line().find("names point 3 of 3"), std::string::npos)
      << file.error().line();
}

TEST(PlyFaces, OfNothingButFacesAreNoMesh) {
  const auto file = read(ascii(kFaceHeader, "3 0 1 2\n"));
  ASSERT_FALSE(file);
  EXPECT_NE(file.error().line().find("no vertices"), std::string::npos) << file.error().line();
}

TEST(PlyFaces, InStripsAreToldOf) {
  const std::string header =
      kPointHeader + "element tristrips 1\nproperty list int int vertex_indices\n";
  const auto file = read(ascii(header, kPoints + "3 0 1 2\n"));
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_TRUE(tells(*file, "\"tristrips\" were not read"));

  std::string whole_mesh = "200000";
  for (int i = 0; i < 200000; ++i) whole_mesh += " " + std::to_string(i % 3);
  const auto longer = read(ascii(header, kPoints + whole_mesh + "\n"));
  ASSERT_TRUE(longer) << longer.error().line();
  EXPECT_TRUE(tells(*longer, "\"tristrips\" were not read"));
}

TEST(PlyFaces, ThatNameNoPointsAreToldOf) {
  const std::string header = kPointHeader + "element face 1\nproperty uchar red\n";
  const auto file = read(ascii(header, kPoints + "255\n"));
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_TRUE(tells(*file, "no list vertex_indices"));
}

}  // namespace
}  // namespace instep
