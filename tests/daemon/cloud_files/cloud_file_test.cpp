#include "daemon/cloud_files/cloud_file.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "daemon/cloud_files/cloud_ply_writer.h"
#include "tests/support/cloud_files.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::CloudFiles;
using test::kPoints;
using test::raw;

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
  cloud.local_errors = {cloud.sigma_mm, 7.5};
  const auto bytes = cloud_to_ply(cloud);
  ASSERT_TRUE(bytes) << bytes.error().line();
  const auto file = read("cloud.ply", *bytes);
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->cloud.positions, cloud.positions);
  EXPECT_EQ(file->cloud.sigma_mm, cloud.sigma_mm);
  EXPECT_EQ(file->cloud.origins, cloud.origins);
  EXPECT_EQ(file->cloud.shared_errors_mm, cloud.shared_errors_mm);
  EXPECT_EQ(file->cloud.local_errors.sigma_mm, cloud.local_errors.sigma_mm);
  EXPECT_EQ(file->cloud.local_errors.reach_mm, 7.5);
  ASSERT_TRUE(file->cloud.has_normals());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_LT((file->cloud.normals[i] - cloud.normals[i]).norm(), 1e-6);
  }
  EXPECT_TRUE(file->mesh.empty());
}

TEST_F(CloudFiles, SaysThatNoiseWithoutAUnitIsNotUsed) {
  const auto file = read("a.ply",
                         "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                         "property float y\nproperty float z\nproperty float sigma\nend_header\n"
                         "0 0 0 0.5\n100 50 60 0.5\n");
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_FALSE(file->cloud.has_sigma());
  ASSERT_EQ(file->notes.size(), 1U);
  EXPECT_NE(file->notes[0].find("sigma_mm"), std::string::npos);
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

TEST_F(CloudFiles, SaysWhenErrorsAlongNormalsAreOfNoUse) {
  const std::string start =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty int x\n"
      "property int y\nproperty int z\nproperty float shared_error_1_mm\n";
  const auto bare = read("bare.ply", start + "end_header\n0 0 0 1\n90 0 0 1\n0 90 0 1\n0 0 90 1\n");
  ASSERT_TRUE(bare) << bare.error().line();
  EXPECT_TRUE(bare->cloud.shared_errors_mm.empty());
  ASSERT_EQ(bare->notes.size(), 1U);
  EXPECT_NE(bare->notes[0].find("along normals"), std::string::npos);
  const auto local = read("local.ply",
                          "ply\nformat ascii 1.0\nelement vertex 2\nproperty int x\n"
                          "property int y\nproperty int z\nproperty int local_error_mm\n"
                          "property int local_error_reach_mm\nend_header\n"
                          "0 0 0 1 9\n90 0 0 1 9\n");
  ASSERT_TRUE(local) << local.error().line();
  EXPECT_TRUE(local->cloud.local_errors.empty());
  EXPECT_EQ(local->notes, bare->notes);
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

/// One without the other says nothing; of several reaches the longest counts.
TEST_F(CloudFiles, ReadsLocalErrorsWithTheirReach) {
  const auto file_with = [this](const std::string& properties, const std::string& second) {
    return read("local.ply",
                "ply\nformat ascii 1.0\nelement vertex 2\nproperty int x\nproperty int y\n"
                "property int z\nproperty int nx\nproperty int ny\nproperty int nz\n" +
                    properties + "end_header\n1 2 3 0 0 1 8 0.5\n9 9 9 0 0 2 " + second + "\n");
  };
  const std::string reach = "property float local_error_reach_mm\n";
  const std::string both = reach + "property double local_error_mm\n";
  const auto file = file_with(both, "9 0");
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->cloud.local_errors.sigma_mm, (std::vector<double>{0.5, 0.0}));
  EXPECT_EQ(file->cloud.local_errors.reach_mm, 9.0);
  const std::string without_reach = "property int a\nproperty double local_error_mm\n";
  for (const auto& broken : {file_with(reach + "property double a\n", "9 0"),
                             file_with(without_reach, "9 0"), file_with(both, "-1 0")}) {
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().code, ErrorCode::kCorruptData) << broken.error().line();
  }
  const auto wild = file_with(both, "9 -0.5");
  ASSERT_FALSE(wild);
  EXPECT_NE(wild.error().message.find("point 1 has a local error"), std::string::npos)
      << wild.error().line();
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

/// A foot lost its ball girth by them.
TEST_F(CloudFiles, ColoursAreNoNormals) {
  for (const char* text :
       {"0 0 0 200 150 130\n9 0 0 190 150 120\n", "0 0 0 .7 .5 .4\n9 0 0 0 0 0\n",
        "# a comment\n0 0 0 255 255 255\n9 0 0 0 0 1\n"}) {
    const auto file = read("c.xyz", text);
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_FALSE(file->cloud.has_normals()) << text;
    ASSERT_FALSE(file->notes.empty()) << text;
    EXPECT_NE(file->notes.back().find("colours"), std::string::npos) << file->notes.back();
  }
  for (const char* text : {"0 0 0 .71 .71 0\n9 0 0 0 .6 .8\n", "0 0 0 0 0 -5\n9 0 0 0 3 0\n",
                           "x y z nx ny nz\n0 0 0 2 2 2\n9 0 0 3 3 3\n"}) {
    const auto file = read("n.xyz", text);
    ASSERT_TRUE(file) << file.error().line();
    EXPECT_TRUE(file->cloud.has_normals()) << text;
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
  const auto normals = read("n.csv", "0,0,0,0,0,2\n10,0,0,0,-1,0\n");
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
  expect_fault("c.pcd", header + "packed\n1234", ErrorCode::kUnsupported, "binary_compressed");
  expect_fault("d.pcd", bytes.substr(0, bytes.size() - 1), ErrorCode::kCorruptData, "short");
}

/// Of two points, with nothing but zeros beside x, y and z.
std::string pcd_of_fields(std::size_t fields) {
  std::string names = "FIELDS x y z";
  std::string sizes = "SIZE";
  std::string types = "TYPE";
  for (std::size_t i = 0; i < fields; ++i) {
    if (i >= 3) names += " f" + std::to_string(i);
    sizes += " 4";
    types += " F";
  }
  return "# .PCD v0.7\n" + names + "\n" + sizes + "\n" + types +
         "\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary\n" + std::string(4 * fields, '\0') +
         raw(10.0F) + std::string(4 * (fields - 1), '\0');
}

// Read as one of fewer fields it gave a wrong place to each point but the first.
TEST_F(CloudFiles, RefusesPcdOfMoreFieldsThanItKnows) {
  const auto file = read("most.pcd", pcd_of_fields(256));
  EXPECT_TRUE(file) << file.error().line();
  expect_fault("more.pcd", pcd_of_fields(257), ErrorCode::kCorruptData, "makes no sense");
  expect_fault("many.pcd", pcd_of_fields(1000), ErrorCode::kCorruptData, "makes no sense");
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
/// The unit is right: to say it again would not help.
TEST_F(CloudFiles, NamesStraysWhereTheyAloneAreFarAway) {
  std::string foot;
  for (int i = 0; i <= 250; ++i) foot += std::to_string(i) + " 0 0\n";
  const auto strayed = read("strayed.xyz", foot + "5000 0 0\n");
  ASSERT_TRUE(strayed && strayed->notes.size() == 1U);
  EXPECT_NE(strayed->notes[0].find("far from all others"), std::string::npos) << strayed->notes[0];
  EXPECT_EQ(strayed->notes[0].find("--unit"), std::string::npos) << strayed->notes[0];
}

TEST_F(CloudFiles, AreOfTheUnitThatMostPointsTell) {
  std::string foot;
  for (int i = 0; i <= 250; ++i) foot += std::to_string(0.1 * i) + " 0 0\n";
  for (const char* stray : {"400 0 0\n", "3000 0 0\n"}) {
    const auto read_so = read("strayed.xyz", foot + stray, LengthUnit::kAuto);
    ASSERT_TRUE(read_so) << read_so.error().line();
    EXPECT_EQ(read_so->unit, LengthUnit::kCentimetre);
  }
  const auto far = read("strayed.xyz", foot + "3000 0 0\n", LengthUnit::kCentimetre);
  ASSERT_TRUE(far && far->notes.size() == 1U);
  EXPECT_NE(far->notes[0].find("far from all others"), std::string::npos) << far->notes[0];
}

// Where a scanner saw nothing some write the origin.
TEST_F(CloudFiles, AreOfTheUnitThatPointsAtOtherPlacesTell) {
  std::string foot;
  for (int i = 0; i <= 250; ++i) foot += i < 2 ? std::to_string(250 * i) + " 0 0\n" : "0 0 0\n";
  const auto read_so = read("unseen.xyz", foot);
  ASSERT_TRUE(read_so) << read_so.error().line();
  EXPECT_EQ(read_so->unit, LengthUnit::kMillimetre);
}

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

}  // namespace
}  // namespace instep
