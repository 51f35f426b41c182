// Organised clouds, as of depth cameras, have a place for every pixel: NaN where it saw nothing.
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/cloud_files.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::raw;
using UnseenPoints = test::CloudFiles;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

const std::string kTold =
    "2 of the file's 4 points were left out: they have a coordinate that is no";

TEST_F(UnseenPoints, OfAPlyTakeTheirNormalsAndNoiseWithThem) {
  const auto file =
      read("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
           "property float sigma_mm\nproperty float shared_error_1_mm\nend_header\n"
           "nan nan nan nan nan nan nan nan\n1 2 3 0 0 1 0.1 0.01\nNaN 2 3 0 1 0 0.2 0.02\n"
           "9 9 9 1 0 0 0.3 0.03\n");
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->cloud.positions, (std::vector<Vector3d>{{1, 2, 3}, {9, 9, 9}}));
  EXPECT_EQ(file->cloud.normals, (std::vector<Vector3d>{{0, 0, 1}, {1, 0, 0}}));
  EXPECT_EQ(file->cloud.sigma_mm, (std::vector<double>{0.1, 0.3}));
  EXPECT_EQ(file->cloud.shared_errors_mm, (std::vector<std::vector<double>>{{0.01, 0.03}}));
  ASSERT_FALSE(file->notes.empty());
  EXPECT_EQ(file->notes.front().substr(0, kTold.size()), kTold);
}

TEST_F(UnseenPoints, OfAnOrganisedPcdAreLeftOut) {
  const std::string head =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 2\n"
      "POINTS 4\nDATA ";
  const float inf = std::numeric_limits<float>::infinity();
  std::string bytes;
  for (const float x : {kNan, kNan, kNan, 1.F, 2.F, 3.F, inf, -inf, inf, 4.F, 50.F, 6.F}) {
    bytes += raw(x);
  }
  const std::string text = "ascii\nnan nan nan\n1 2 3\n-nan inf -inf\n4 50 6\n";
  for (const auto& body : {"binary\n" + bytes, text}) {
    const auto file = read("a.pcd", head + body);
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_EQ(file->cloud.positions, (std::vector<Vector3d>{{1, 2, 3}, {4, 50, 6}}));
    ASSERT_FALSE(file->notes.empty());
    EXPECT_EQ(file->notes.front().substr(0, kTold.size()), kTold);
  }
}

TEST_F(UnseenPoints, OfATextAreLeftOutWhateverPartsItsNumbers) {
  for (const char* text : {"nan nan nan\n1 2 3\nnan nan nan\n4 50 6.5\n",
                           "NaN;NaN;NaN\n1;2;3\nNaN;NaN;NaN\n4;50;6,5\n",
                           "x,y,z\nNaN, NaN, NaN\n1, 2, 3\nNaN,NaN,NaN\n4, 50, 6.5\n"}) {
    const auto file = read("a.xyz", text);
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_EQ(file->cloud.positions, (std::vector<Vector3d>{{1, 2, 3}, {4, 50, 6.5}}));
    ASSERT_FALSE(file->notes.empty());
    EXPECT_EQ(file->notes.front().substr(0, kTold.size()), kTold);
  }
}

TEST_F(UnseenPoints, OfAPlyTakeTheirFacesWithThem) {
  const auto file =
      read("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
           "property float z\nelement face 3\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0\nnan nan nan\n2 0 0\n2 2 0\n0 2 0\n3 0 1 2\n3 0 2 3\n3 0 3 4\n");
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->mesh.positions,
            (std::vector<Vector3d>{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}));
  EXPECT_EQ(file->mesh.triangles,
            (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  ASSERT_FALSE(file->notes.empty());
  EXPECT_NE(file->notes.front().find("faces that went with them: 1"), std::string::npos);
}

TEST_F(UnseenPoints, OfMeshesOfOtherKindsTakeTheirFacesWithThem) {
  std::string stl(80, ' ');
  stl += raw(2U);
  for (const float first : {0.F, kNan}) {
    stl += std::string(12, '\0');
    for (const float x : {first, 0.F, 0.F, 10.F, 0.F, 0.F, 10.F, 10.F, 0.F}) stl += raw(x);
    stl += std::string(2, '\0');
  }
  const std::string obj = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv nan nan nan\nf 1 2 3\nf 1 3 4\n";
  for (const auto& [name, bytes] : {std::pair("m.stl", stl), {"m.obj", obj}}) {
    const auto file = read(name, bytes);
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_EQ(file->mesh.triangles.size(), 1U) << name;
    EXPECT_EQ(file->mesh.positions.size(), 3U) << name;
    ASSERT_FALSE(file->notes.empty());
    EXPECT_NE(file->notes.front().find("faces that went with them: 1"), std::string::npos);
  }
}

TEST_F(UnseenPoints, OfWhichTooManyWereLeftOutAreToldInTheRefusal) {
  expect_fault("none.xyz", "nan nan nan\nnan 1 2\n", ErrorCode::kInsufficientData,
               "of the 2 points of");
  expect_fault("one.xyz", "nan nan nan\n1 2 3\n", ErrorCode::kInsufficientData,
               "1 of the file's 2 points were left out");
}

TEST_F(UnseenPoints, ThatAreAbsurdAreLeftOutOnlyWhereTheyAreFew) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += std::to_string(i) + " 2 3\n";
  const auto file = read("a.xyz", text + "1e300 2 3\nnan 2 3\n");
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->cloud.size(), 100U);
  ASSERT_GE(file->notes.size(), 2U);
  EXPECT_NE(file->notes[0].find("1 of the file's 102"), std::string::npos);
  EXPECT_NE(file->notes[1].find("absurdly large"), std::string::npos);
  expect_fault("b.xyz", text + "1e300 2 3\n1e30 2 3\n", ErrorCode::kInvalidInput,
               "2 of the 102 points of");
}

}  // namespace
}  // namespace instep
