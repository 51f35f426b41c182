#include "daemon/cloud_files/mesh_ply_writer.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "daemon/cloud_files/cloud_file.h"
#include "tests/support/random_numbers.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

TriangleMesh random_mesh() {
  test::RandomNumbers random(3);
  TriangleMesh mesh;
  for (int i = 0; i < 500; ++i) {
    mesh.positions.emplace_back(80 * random.normal(), 30 * random.normal(), 20 * random.normal());
  }
  for (int i = 0; i < 900; ++i) {
    std::array<std::uint32_t, 3> corners;
    for (auto& corner : corners) corner = static_cast<std::uint32_t>(random.below(500));
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

TEST(MeshPlyWriter, MeshComesBackBitByBit) {
  const test::TemporaryFolder folder;
  const auto mesh = random_mesh();
  ASSERT_TRUE(write_mesh_ply(mesh, folder.path() / "mesh.ply"));
  const auto file = read_cloud_file(folder.path() / "mesh.ply", LengthUnit::kMillimetre);
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->mesh.positions, mesh.positions);
  EXPECT_EQ(file->mesh.triangles, mesh.triangles);
}

TEST(MeshPlyWriter, RefusesFacesWithoutCorners) {
  auto mesh = random_mesh();
  mesh.triangles[5][1] = 500;
  const auto bytes = mesh_to_ply(mesh);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::kInvalidInput);
}

TEST(MeshPlyWriter, LeavesNothingWhereItCannotWrite) {
  const test::TemporaryFolder folder;
  const auto written = write_mesh_ply(random_mesh(), folder.path() / "none" / "mesh.ply");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace instep
