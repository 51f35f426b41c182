#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <string>

#include "tests/support/cloud_files.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::kPoints;
using test::raw;
using MeshFiles = test::CloudFiles;

/// Two triangles.
std::string binary_stl() {
  std::string stl(80, ' ');
  stl += raw(2U);
  for (const auto& corners : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    stl += std::string(12, '\0');
    for (const int corner : corners) {
      const auto& point = kPoints[static_cast<std::size_t>(corner)];
      for (int axis = 0; axis < 3; ++axis) stl += raw(static_cast<float>(point[axis]));
    }
    stl += std::string(2, '\0');
  }
  return stl;
}

TEST_F(MeshFiles, ReadsMeshesAndJoinsTheirCorners) {
  const auto obj = read("m.obj", "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3 4\n");
  ASSERT_TRUE(obj) << obj.error().line();
  EXPECT_EQ(obj->mesh.triangles.size(), 2U);
  EXPECT_EQ(obj->mesh.positions.size(), 4U);
  const std::string stl = binary_stl();
  const auto mesh = read("m.STL", stl);
  ASSERT_TRUE(mesh) << mesh.error().line();
  EXPECT_EQ(mesh->mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh->mesh.positions.size(), 4U);
  expect_fault("cut.stl", stl.substr(0, 150), ErrorCode::kCorruptData, "too short");
  expect_fault("none.obj", "hello\n", ErrorCode::kInsufficientData, "no points");
}

/// assimp takes a binary file of another size than its header tells for a text.
TEST_F(MeshFiles, ReadsABinaryStlThatGoesOnAfterItsLastTriangle) {
  for (const std::string& surplus :
       {std::string("\n"), std::string("more"), std::string(512, '\0')}) {
    const auto file = read("m.stl", binary_stl() + surplus);
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_EQ(file->mesh.triangles.size(), 2U);
    const auto is_told = std::any_of(file->notes.begin(), file->notes.end(), [](const auto& note) {
      return note.find("goes on for 4 bytes") != note.npos;
    });
    EXPECT_EQ(is_told, surplus == "more");
  }
}

TEST_F(MeshFiles, ReadsATextStlInAnyCase) {
  std::string text =
      "SOLID Foot\n FACET NORMAL 0 0 1\n  OUTER LOOP\n   VERTEX 0 0 0\n   VERTEX 1E1 0 0\n"
      "   VERTEX 10 10 0\n  ENDLOOP\n ENDFACET\n";
  expect_fault("cut.stl", text, ErrorCode::kCorruptData, "endsolid");
  text += "ENDSOLID Foot\n";
  for (const char* name : {"m.stl", "m"}) {
    const auto file = read(name, text);
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_EQ(file->format, "STL, text");
    EXPECT_EQ(file->mesh.triangles.size(), 1U);
  }
}

TEST_F(MeshFiles, OpensNoFileThatAMeshNames) {
  const auto pipe = folder_.path() / "pipe.mtl";  // to open it is to wait for ever
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& name :
       {std::string("pipe.mtl"), pipe.string(), std::string("none.mtl")}) {
    const auto file =
        read("m.obj", "mtllib " + name + "\nv 0 0 0\nv 10 0 0\nv 10 10 0\nusemtl skin\nf 1 2 3\n");
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_EQ(file->mesh.triangles.size(), 1U);
  }
}

TEST_F(MeshFiles, TakesOfAnObjFileItsShapeAlone) {
  const std::string corners = "v 0 0 0 1\nv 10 0 0 0.5 0.5 0.5\nv 10 10 0\n";
  for (const char* face : {"f 1/4/9 2/5/9 3/6/9\n", "f 1//1 2//2 3//3\n", "f -3 -2 -1\n",
                           "f 1 \\\n2 3\n", "usemtl \x85\x02\nvn 1\ncurv2 1\ng\nf 1 2 3\n"}) {
    const auto file = read("m.obj", corners + face);
    ASSERT_TRUE(file) << face << file.error().line();
    EXPECT_EQ(file->mesh.triangles.size(), 1U) << face;
    EXPECT_EQ(file->mesh.positions.size(), 3U) << face;
  }
  const auto last = read("m.obj", "# C:\\scans\\\n" + corners + "f 1 2 3 \\");
  ASSERT_TRUE(last) << last.error().line();
  EXPECT_EQ(last->mesh.positions.size(), 3U);
  const auto before = read("m.obj", "f 1 2 3\n" + corners);
  ASSERT_TRUE(before) << before.error().line();
  EXPECT_EQ(before->mesh.triangles.size(), 1U);
  for (const char* face : {"f 1 2 4\n", "f 0 1 2\n", "f 1 2 -4\n", "f 1 2 x\n", "f 1 2 2.5\n",
                           "f 1 2 /3\n", "f 1 2 99999999999999999999\n", "f 1 2 nan\n"}) {
    expect_fault("m.obj", corners + face, ErrorCode::kCorruptData, "a face (f)");
  }
  expect_fault("m.obj", corners + "v 1 2\nf 1 2 3\n", ErrorCode::kCorruptData, "a corner (v)");
}

TEST_F(MeshFiles, CoversLargeFacesWithPointsAndNormals) {
  const auto file = read("m.obj",
                         "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 2 3\nf 1 4 2\nf 1 3 4\n"
                         "f 2 4 3\n");  // wound inwards
  ASSERT_TRUE(file) << file.error().line();
  ASSERT_TRUE(file->cloud.has_normals());
  EXPECT_GT(file->cloud.size(), 3000U);
  for (std::size_t i = 0; i < file->cloud.size(); ++i) {
    const auto& p = file->cloud.positions[i];
    EXPECT_GT(file->cloud.normals[i].dot(p - Vector3d(20, 20, 20)), 0.0);
  }
}

}  // namespace
}  // namespace instep
