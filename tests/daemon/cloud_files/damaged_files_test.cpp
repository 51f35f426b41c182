#include <gtest/gtest.h>

#include <random>

#include "daemon/cloud_files/cloud_ply_writer.h"
#include "tests/support/cloud_files.h"

namespace instep {
namespace {

using test::kPoints;
using test::raw;
using DamagedFiles = test::CloudFiles;

TEST_F(DamagedFiles, AreToldWithTheirFault) {
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
  expect_fault("nan.ply", head + "2" + xyz + "nan 2 3\nnan 2 3\n", ErrorCode::kInsufficientData,
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

/// As spreadsheets and loggers write them; all that was said is that it is no cloud.
TEST_F(DamagedFiles, OfTextThatIsNearlyACloudTellTheLineAndWhatToDo) {
  const auto corrupt = ErrorCode::kCorruptData;
  for (const char* text :
       {"\"1.5\",\"2.0\",\"3.0\"\n", "\"1,5\";\"2,0\";\"3,0\"\n", "'1' '2' '3'\n"}) {
    expect_fault("quotes.csv", text, corrupt, "line 1 of");
    expect_fault("quotes.csv", text, corrupt, "without quotes");
    expect_fault("quotes.csv", std::string("\"x\",\"y\",\"z\"\n") + text, corrupt, "line 2 of");
  }
  for (const char* text :
       {"x y z\nmm mm mm\n1 2 3\n4 5 6\n", "Foot of Anna\nx,y,z\n1,2,3\n4,5,6\n"}) {
    expect_fault("headings.xyz", text, corrupt, "line 2 of");
    expect_fault("headings.xyz", text, corrupt, "begin all others with #");
  }
  expect_fault("broken.xyz", "x y z\n1 2 abc\n4 5 6\n", corrupt, "line 2 of");
  expect_fault("empty.csv", "x,y,z\n,,\n1,2,3\n4,5,6\n", corrupt, "has 0 numbers");
  expect_fault("essay.txt", "one\ntwo\nthree\nfour\n1 2 3\n", ErrorCode::kUnsupported, "give PLY");
}

TEST_F(DamagedFiles, OfTextInUtf16SayHowToSaveIt) {
  for (const bool is_big : {false, true}) {
    std::string wide;
    for (const char letter : std::string("x y z\r\n1.5 2.5 3.5\r\n4 5 6\r\n")) {
      wide += is_big ? std::string{'\0', letter} : std::string{letter, '\0'};
    }
    const std::string mark = is_big ? "\xFE\xFF" : "\xFF\xFE";
    for (const auto& text : {mark + wide, wide}) {
      expect_fault("wide.xyz", text, ErrorCode::kUnsupported, "UTF-16");
      expect_fault("wide.csv", text, ErrorCode::kUnsupported, "save it as UTF-8");
    }
  }
}

/// Damages sound files at random; whatever happens must be a value or an error.
TEST_F(DamagedFiles, TwoThousandAreSurvived) {
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
