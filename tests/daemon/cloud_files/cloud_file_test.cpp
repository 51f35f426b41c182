#include "daemon/cloud_files/cloud_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>

#include "daemon/cloud_files/cloud_ply_writer.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using Eigen::Vector3d;

template <typename T>
std::string raw(T value, bool big = false) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return {bytes.data(), bytes.size()};
}

class CloudFiles : public testing::Test {
 protected:
  Result<CloudFile> read(const std::string& name, const std::string& bytes,
                         LengthUnit unit = LengthUnit::kMillimetre) {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return read_cloud_file(folder_.path() / name, unit);
  }

  /// Expects an error of that code whose line holds `said` and the file's name.
  void expect_fault(const std::string& name, const std::string& bytes, ErrorCode code,
                    const std::string& said, LengthUnit unit = LengthUnit::kMillimetre) {
    const auto file = read(name, bytes, unit);
    ASSERT_FALSE(file) << said;
    EXPECT_EQ(file.error().code, code) << file.error().line();
    EXPECT_NE(file.error().line().find(said), std::string::npos) << file.error().line();
    EXPECT_NE(file.error().message.find(name), std::string::npos) << file.error().line();
    EXPECT_FALSE(file.error().advice.empty());
  }

  test::TemporaryFolder folder_;
};

const std::vector<Vector3d> kPoints = {{0, 0, 0}, {10, 0.5, 0}, {0, 20.25, 3}, {-1, 2, 30}};

TEST_F(CloudFiles, WrittenCloudComesBackBitByBit) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0.0, 50.0);
  PointCloud cloud;
  for (int i = 0; i < 1000; ++i) {
    cloud.positions.emplace_back(normal(random), normal(random), normal(random));
    cloud.normals.push_back(Vector3d(normal(random), normal(random), 9).normalized());
    cloud.sigma_mm.push_back(0.25 + i * 0.0625);
    cloud.origins.push_back(i % 3 == 0 ? PointOrigin::kPlatform : PointOrigin::kSeen);
  }
  cloud.shared_errors_mm = {std::vector<double>(1000, -0.375), cloud.sigma_mm};
  ASSERT_TRUE(write_cloud_ply(cloud, folder_.path() / "cloud.ply"));
  const auto file = read_cloud_file(folder_.path() / "cloud.ply", LengthUnit::kMillimetre);
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->cloud.positions, cloud.positions);
  EXPECT_EQ(file->cloud.sigma_mm, cloud.sigma_mm);
  EXPECT_EQ(file->cloud.origins, cloud.origins);
  EXPECT_EQ(file->cloud.shared_errors_mm, cloud.shared_errors_mm);
  ASSERT_TRUE(file->cloud.has_normals());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_LT((file->cloud.normals[i] - cloud.normals[i]).norm(), 1e-6);
  }
  EXPECT_TRUE(file->mesh.empty());
  std::ostringstream stream;
  ASSERT_TRUE(write_cloud_ply(cloud, stream));
  EXPECT_EQ(stream.str(), *cloud_to_ply(cloud));
}

TEST_F(CloudFiles, ReadsAsciiPlyWithPropertiesOfAnyKindAndOrder) {
  const auto file = read("a.ply",
                         "ply\r\nformat ascii 1.0\r\ncomment x\r\nelement thing 2\r\n"
                         "property list uchar int members\r\nproperty float q\r\n"
                         "element vertex 3\r\nproperty double z\r\nproperty uchar red\r\n"
                         "property int x\r\nproperty float y\r\nproperty double sigma_mm\r\n"
                         "end_header\r\n3 7 8 9 0.5\r\n0 0.5\r\n"
                         "1.125 255 1 2.5 0.1\r\n30 0 -4 5 0.2\r\n6 1 7 8 0.30000000000000004\r\n");
  ASSERT_TRUE(file) << file.error().line();
  const std::vector<Vector3d> expected = {{1, 2.5, 1.125}, {-4, 5, 30}, {7, 8, 6}};
  EXPECT_EQ(file->cloud.positions, expected);
  EXPECT_EQ(file->cloud.sigma_mm, (std::vector<double>{0.1, 0.2, 0.30000000000000004}));
}

TEST_F(CloudFiles, SaysWhenSharedErrorsAreOfNoUse) {
  const std::string start =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty int x\n"
      "property int y\nproperty int z\nproperty float shared_error_1_mm\n";
  const auto bare = read("bare.ply", start + "end_header\n0 0 0 1\n90 0 0 1\n0 90 0 1\n0 0 90 1\n");
  ASSERT_TRUE(bare) << bare.error().line();
  EXPECT_TRUE(bare->cloud.shared_errors_mm.empty());
  ASSERT_EQ(bare->notes.size(), 1U);
  EXPECT_NE(bare->notes[0].find("along normals"), std::string::npos);
  const auto mesh = read("mesh.ply", start +
                                         "property int nx\nproperty int ny\nproperty int nz\n"
                                         "element face 1\nproperty list uchar int vertex_index\n"
                                         "end_header\n0 0 0 1 0 0 1\n90 0 0 1 0 0 1\n"
                                         "0 90 0 1 0 0 1\n0 0 90 1 0 0 1\n3 0 1 2\n");
  ASSERT_TRUE(mesh) << mesh.error().line();
  EXPECT_GT(mesh->cloud.size(), 4U);
  EXPECT_TRUE(mesh->cloud.shared_errors_mm.empty());
  ASSERT_FALSE(mesh->notes.empty());
  EXPECT_NE(mesh->notes.back().find("on its faces"), std::string::npos) << mesh->notes.back();
}

/// In any order; none is passed over.
TEST_F(CloudFiles, ReadsSharedErrors) {
  const auto file_with = [this](const std::string& first, const std::string& second) {
    return read("shared.ply",
                "ply\nformat ascii 1.0\nelement vertex 2\nproperty int x\nproperty int y\n"
                "property int z\nproperty int nx\nproperty int ny\nproperty int nz\nproperty " +
                    first + "\nproperty " + second +
                    "\nend_header\n1 2 3 0 0 1 20 10\n9 9 9 0 0 2 -21 -11\n");
  };
  const auto file = file_with("float shared_error_2_mm", "double shared_error_1_mm");
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->cloud.shared_errors_mm, (std::vector<std::vector<double>>{{10, -11}, {20, -21}}));
  for (const char* other : {"float shared_error_3_mm", "float shared_error_0_mm",
                            "list int int shared_error_2_mm", "float shared_error_1_mm"}) {
    const auto broken = file_with("float shared_error_1_mm", other);
    ASSERT_FALSE(broken) << other;
    EXPECT_EQ(broken.error().code, ErrorCode::kCorruptData) << broken.error().line();
  }
}

TEST_F(CloudFiles, ReadsBinaryPlyOfBothByteOrders) {
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\nelement vertex 4\nproperty short tag\nproperty double x\n"
                        "property float y\nproperty int z\nproperty list uchar ushort near\n"
                        "element face 2\nproperty list uint uint vertex_index\nproperty char c\n"
                        "end_header\n";
    for (std::size_t i = 0; i < 4; ++i) {
      bytes += raw(std::int16_t{7}, big) + raw(kPoints[i].x(), big) +
               raw(static_cast<float>(kPoints[i].y()), big) +
               raw(static_cast<std::int32_t>(kPoints[i].z()), big) + raw(std::uint8_t{1}) +
               raw(std::uint16_t{3}, big);
    }
    bytes += raw(3U, big) + raw(0U, big) + raw(1U, big) + raw(2U, big) + "c";
    bytes += raw(4U, big) + raw(0U, big) + raw(1U, big) + raw(2U, big) + raw(3U, big) + "c";
    const auto file = read("b.ply", bytes);
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_EQ(file->mesh.positions, kPoints);
    const std::vector<std::array<std::uint32_t, 3>> fans = {{0, 1, 2}, {0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(file->mesh.triangles, fans);
  }
}

TEST_F(CloudFiles, ReadsTextWithAnySeparator) {
  for (const char* text : {"0 0 0\n10 0.5 0\n0 20.25 3\n-1 2 30",
                           "x,y,z\n0,0,0\r\n10,0.5,0\r\n0,20.25,3\r\n-1,2,30\r\n",
                           "# made of SCAN.PCD\n0 0 0\n10 0.5 0\n0 20.25 3\n-1 2 30\n",
                           "# by hand\n0;0;0\n\n10;0.5;0\n// more\n0;20.25;3\n-1;2;30\n",
                           "4\n0\t0\t0\n+10\t5e-1\t0\n0\t20.25\t3\n-1\t2\t30\n"}) {
    const auto file = read("points.xyz", text);
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_EQ(file->cloud.positions, kPoints) << text;
  }
  const auto normals = read("n.csv", "0,0,0,0,0,2\n10,0,0,0,1,0\n");
  ASSERT_TRUE(normals);
  EXPECT_EQ(normals->cloud.normals[0], Vector3d::UnitZ());
}

TEST_F(CloudFiles, ReadsPcd) {
  const std::string header =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS rgb x y z\nSIZE 4 4 8 4\nTYPE U F F I\nCOUNT 2 1 1 1\n"
      "WIDTH 4\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA ";
  auto file =
      read("a.pcd", header + "ascii\n9 9 0 0 0\n9 9 10 0.5 0\n9 9 0 20.25 3\n9 9 -1 2 30\n");
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->cloud.positions, kPoints);
  std::string bytes = header + "binary\n";
  for (const auto& point : kPoints) {
    bytes += "12345678" + raw(static_cast<float>(point.x())) + raw(point.y()) +
             raw(static_cast<std::int32_t>(point.z()));
  }
  file = read("b.pcd", bytes);
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->cloud.positions, kPoints);
  expect_fault("c.pcd", header + "binary_compressed\n1234", ErrorCode::kUnsupported, "convert");
  expect_fault("d.pcd", bytes.substr(0, bytes.size() - 1), ErrorCode::kCorruptData, "short");
}

TEST_F(CloudFiles, ReadsMeshesAndJoinsTheirCorners) {
  const auto obj = read("m.obj", "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3 4\n");
  ASSERT_TRUE(obj) << obj.error().line();
  EXPECT_EQ(obj->mesh.triangles.size(), 2U);
  EXPECT_EQ(obj->mesh.positions.size(), 4U);
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
  const auto mesh = read("m.STL", stl);
  ASSERT_TRUE(mesh) << mesh.error().line();
  EXPECT_EQ(mesh->mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh->mesh.positions.size(), 4U);
  expect_fault("cut.stl", stl.substr(0, 150), ErrorCode::kCorruptData, "too short");
  expect_fault("none.obj", "hello\n", ErrorCode::kInsufficientData, "no points");
}

TEST_F(CloudFiles, OpensNoFileThatAMeshNames) {
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

TEST_F(CloudFiles, TakesOfAnObjFileItsShapeAlone) {
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

TEST_F(CloudFiles, CoversLargeFacesWithPointsAndNormals) {
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

TEST_F(CloudFiles, SettlesTheUnit) {
  const std::string foot = "0 0 0\n0.25 0 0\n0.1 0.1 0.05\n";
  const auto metres = read("foot.xyz", foot, LengthUnit::kMetre);
  ASSERT_TRUE(metres);
  EXPECT_DOUBLE_EQ(metres->cloud.positions[1].x(), 250.0);
  const auto automatic = read("foot.xyz", foot, LengthUnit::kAuto);
  ASSERT_TRUE(automatic);
  EXPECT_EQ(automatic->unit, LengthUnit::kMetre);
  ASSERT_EQ(automatic->notes.size(), 1U);
  EXPECT_NE(automatic->notes[0].find("taken to be m"), std::string::npos);
  expect_fault("foot.xyz", foot, ErrorCode::kInvalidInput, "--unit m");
  expect_fault("foot.xyz", "0 0 0\n250 0 0\n", ErrorCode::kInvalidInput, "--unit mm",
               LengthUnit::kMetre);
  expect_fault("foot.xyz", "0 0 0\n5 0 0\n", ErrorCode::kInvalidInput, "say its unit",
               LengthUnit::kAuto);
}

TEST_F(CloudFiles, NamesTheUnitOfAFootThatIsTooSmallOrTooLarge) {
  for (const auto unit : {LengthUnit::kMillimetre, LengthUnit::kAuto}) {
    expect_fault("micrometres.xyz", "0 0 0\n250000 0 0\n1e4 1e5 0\n", ErrorCode::kInvalidInput,
                 "micrometres", unit);
  }
  expect_fault("metres.xyz", "0 0 0\n0.25 0 0\n", ErrorCode::kInvalidInput, "--unit m");
  // Ten times too small can be a toe, so it is read, but not without a word.
  const auto centimetres = read("centimetres.xyz", "0 0 0\n25 0 0\n10 10 5\n");
  ASSERT_TRUE(centimetres) << centimetres.error().line();
  ASSERT_EQ(centimetres->notes.size(), 1U);
  EXPECT_NE(centimetres->notes[0].find("--unit cm"), std::string::npos) << centimetres->notes[0];
  const auto millimetres = read("mm.xyz", "0 0 0\n250 0 0\n100 100 50\n", LengthUnit::kCentimetre);
  ASSERT_TRUE(millimetres) << millimetres.error().line();
  ASSERT_EQ(millimetres->notes.size(), 1U);
  EXPECT_NE(millimetres->notes[0].find("--unit mm"), std::string::npos) << millimetres->notes[0];
  const auto sound = read("mm.xyz", "0 0 0\n250 0 0\n100 100 50\n");
  ASSERT_TRUE(sound);
  EXPECT_TRUE(sound->notes.empty());
}

/// As tables are written where a comma marks the decimals; six numbers would be points of no body.
TEST_F(CloudFiles, ReadsDecimalCommas) {
  for (const std::string text :
       {"x;y;z\n1,5;-2,25;3\n4;5;6,125\n", "1,5 -2,25 3\n4 5 6,125\n",
        "1,5\t-2,25\t3,0\r\n4,0\t5,0\t6,125\r\n", "1.5,-2.25,3\n4,5,6.125 \n",
        "1.5, -2.25, 3\n4 , 5 , 6.125\n", "1.5, -2.25, 3;\n4, 5, 6.125;\n"}) {
    const auto file = read("table.csv", text);
    ASSERT_TRUE(file) << text << file.error().line();
    ASSERT_EQ(file->cloud.size(), 2U) << text;
    EXPECT_FALSE(file->cloud.has_normals()) << text;
    EXPECT_EQ(file->cloud.positions[0], Eigen::Vector3d(1.5, -2.25, 3.0)) << text;
    EXPECT_EQ(file->cloud.positions[1], Eigen::Vector3d(4.0, 5.0, 6.125)) << text;
  }
  const auto with_normals = read("n.csv", "1,2,3 0,0,1\n4,5,6 0,0,1\n");
  ASSERT_TRUE(with_normals) << with_normals.error().line();
  EXPECT_EQ(with_normals->cloud.normals[1], Eigen::Vector3d(0.0, 0.0, 1.0));
}

TEST_F(CloudFiles, TellsEveryFault) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex ";
  const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const auto corrupt = ErrorCode::kCorruptData;
  expect_fault("empty.ply", "", corrupt, "is empty");
  expect_fault("text.ply", "hello", corrupt, "begin with");
  expect_fault("cut.ply", "ply\nformat ascii 1.0\n", corrupt, "no end");
  expect_fault("lies.ply", head + "99999999999" + xyz + "1 2 3\n", corrupt, "too short");
  expect_fault("count.ply", head + "-1" + xyz, corrupt, "makes no sense");
  expect_fault("cut2.ply", head + "2" + xyz + "11111 2222 3333\n1 2\n", corrupt, "cut short");
  expect_fault("none.ply", head + "0" + xyz, ErrorCode::kInsufficientData, "no points");
  expect_fault("noz.ply", head + "1\nproperty float x\nproperty float y\nend_header\n1 2\n",
               corrupt, "lack");
  expect_fault("nan.ply", head + "2" + xyz + "nan 2 3\n1 2 3\n", ErrorCode::kInvalidInput,
               "no number");
  expect_fault("huge.ply", head + "2" + xyz + "1e30 2 3\n1 2 3\n", ErrorCode::kInvalidInput,
               "absurdly large");
  expect_fault("same.ply", head + "2" + xyz + "1 2 3\n1 2 3\n", ErrorCode::kInsufficientData,
               "the same");
  expect_fault("face.ply",
               "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\n"
               "property int z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n1 2 3\n3 0 0 1\n",
               corrupt, "names point 1");
  expect_fault("sigma.ply",
               "ply\nformat ascii 1.0\nelement vertex 2\nproperty int x\nproperty int y\n"
               "property int z\nproperty float sigma_mm\nend_header\n1 2 3 0.1\n9 9 9 0\n",
               ErrorCode::kInvalidInput, "sigma");
  expect_fault("shared.ply",
               "ply\nformat ascii 1.0\nelement vertex 2\nproperty int x\nproperty int y\n"
               "property int z\nproperty int nx\nproperty int ny\nproperty int nz\n"
               "property float shared_error_1_mm\nproperty float shared_error_2_mm\nend_header\n"
               "1 2 3 0 0 1 0.1 -0.1\n9 9 9 0 0 1 0.1 nan\n",
               ErrorCode::kInvalidInput, "point 1 has a shared error");
  std::string many =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\n"
      "property int z\n";
  for (int i = 1; i <= 201; ++i) {
    many += "property int shared_error_" + std::to_string(i) + "_mm\n";
  }
  expect_fault("many.ply", many + "end_header\n1 2 3" + std::string(402, ' '),
               ErrorCode::kUnsupported, "201 properties of shared errors");
  expect_fault("words.xyz", "0 0 0\nhello world you\n", corrupt, "line 2");
  expect_fault("columns.xyz", "0 0 0\n1 2 3 0 0 1\n", corrupt, "line 2");
  expect_fault("comma.csv", "1,5;2,5;3\n1,2;3,4,5;6\n", corrupt, "line 2");
  expect_fault("comma.csv", "1,2;3,4,5;6\n", corrupt, "cannot be told");
  expect_fault("comma.csv", "1,5 2,5 3,5\n1,2,3\n", corrupt, "line 2");
  expect_fault("comma.csv", "1,2,3\n1,5 2,5 3,5\n", corrupt, "line 2");
  // Commas that part thousands, as decimal points in the line or in another one show.
  expect_fault("comma.csv", "1,234 500.5 30.25\n999 500 30\n", corrupt, "line 1");
  expect_fault("comma.csv", "1,234.5 500 30\n999 500 30\n", corrupt, "line 1");
  expect_fault("comma.csv", "1,234 500 30\n999.5 500 30\n", corrupt, "line 2");
  expect_fault("comma.csv", "999.5 500 30\n1,234 500 30\n", corrupt, "line 2");
  expect_fault("picture.jpg", "\xff\xd8\xff\xe0 JFIF", ErrorCode::kUnsupported, "give PLY");
  EXPECT_EQ(read_cloud_file(folder_.path() / "missing.ply", LengthUnit::kAuto).error().code,
            ErrorCode::kNotFound);
  EXPECT_NE(read_cloud_file(folder_.path(), LengthUnit::kAuto).error().line().find("is a folder"),
            std::string::npos);
}

/// Damages sound files at random; whatever happens must be a value or an error.
TEST_F(CloudFiles, SurvivesTwoThousandDamagedFiles) {
  std::string ascii =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
      "end_header\n0 0 0\n10 0 0\n0 20 3\n-1 2 30\n4 0 1 2 3\n";
  std::string stl(80, ' ');
  stl += raw(1U) + std::string(12, '\0');
  for (int i = 0; i < 9; ++i) stl += raw(static_cast<float>(i * i));
  stl += std::string(2, '\0');
  PointCloud cloud;
  cloud.positions = kPoints;
  cloud.sigma_mm = {1, 1, 1, 1};
  const std::vector<std::pair<std::string, std::string>> seeds = {
      {"f.ply", ascii},
      {"f.ply", *cloud_to_ply(cloud)},
      {"f.pcd",
       "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
       "POINTS 2\nDATA binary\nabcdefghijklmnopqrstuvwx"},
      {"f.xyz", "x y z\n0 0 0\n10 0 0\n0 20 3\n-1 2 30\n"},
      {"f.obj", "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n"},
      {"f.stl", stl},
      {"f.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\n"
       "vertex 0 9 0\nendloop\nendfacet\nendsolid a\n"}};
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    auto [name, bytes] = seeds[random() % seeds.size()];
    if (random() % 3 == 0) bytes.resize(random() % bytes.size());
    for (auto flips = random() % 4; flips > 0 && !bytes.empty(); --flips) {
      auto& byte = bytes[random() % bytes.size()];
      byte = static_cast<char>(byte ^ static_cast<char>(1U << (random() % 8)));
    }
    const auto file = read(name, bytes, i % 2 == 0 ? LengthUnit::kMillimetre : LengthUnit::kAuto);
    if (file) {
      EXPECT_TRUE(check_cloud(file->cloud));
    } else {
      EXPECT_FALSE(file.error().message.empty());
    }
  }
}

}  // namespace
}  // namespace instep
