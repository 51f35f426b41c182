#include "daemon/cloud_files/text_cloud_reader.h"

#include <gtest/gtest.h>

#include <string>

namespace instep {
namespace {

using Eigen::Vector3d;

const Vector3d kFirst(1.5, -2.0, 3.0);
const Vector3d kSecond(4.0, 5.0, 6.0);

void expect_both(const std::string& text) {
  const auto raw = read_text_cloud(text, "t.csv");
  ASSERT_TRUE(raw) << text << raw.error().line();
  ASSERT_EQ(raw->cloud.size(), 2U) << text;
  EXPECT_EQ(raw->cloud.positions[0], kFirst) << text;
  EXPECT_EQ(raw->cloud.positions[1], kSecond) << text;
}

TEST(TextCloudReader, TakesColumnsByTheirNames) {
  for (const char* text :
       {"y,z,x\n-2,3,1.5\n5,6,4\n", "y;z;x; \n-2;3;1.5;\n5;6;4;\n", "y z x\t\n-2 3 1.5\n5 6 4\n",
        "Z;X;Y\n3;1,5;-2\n6;4;5\n", "x y z r g b\n1.5 -2 3 200 10 10\n4 5 6 10 10 10\n",
        "id,time,x,y,z,q\n1,0.1,1.5,-2,3,0\n2,0.2,4,5,6,0\n",
        "\"x [mm]\",\"y [mm]\",\"z [mm]\",\"c\"\n1.5,-2,3,9\n4,5,6,9\n",
        "X (mm) Y (mm) Z (mm)\n1.5 -2 3\n4 5 6\n", "X Coord,Y Coord,Z Coord\n1.5,-2,3\n4,5,6\n",
        "x mm;y mm;z mm\n1.5;-2;3\n4;5;6\n", "Point ID,z,x,y,q\n1,3,1.5,-2,0\n2,6,4,5,0\n",
        "# z, y, x\n\n# 2 points\n3, -2, 1.5\n6, 5, 4\n",
        "//X Y Z Intensity\n1.5 -2 3 7\n4 5 6 7\n", "# z, y, x\n3, -2, 1.5\n6, 5, 4\n"}) {
    expect_both(text);
  }
}

TEST(TextCloudReader, TakesColoursForNoNormals) {
  const auto raw = read_text_cloud("x,y,z,r,g,b\n1,2,3,10,20,30\n", "t.csv");
  ASSERT_TRUE(raw);
  EXPECT_FALSE(raw->cloud.has_normals());
}

TEST(TextCloudReader, TakesNormalsAndNoiseByTheirNames) {
  for (const char* text : {"nx,ny,nz,x,y,z,sigma_mm\n0,0,1,1.5,-2,3,0.25\n",
                           "sigma_mm Normal_X Normal_Y Normal_Z z x y\n0.25 0 0 1 3 1.5 -2\n"}) {
    const auto raw = read_text_cloud(text, "t.csv");
    ASSERT_TRUE(raw) << raw.error().line();
    EXPECT_EQ(raw->cloud.positions[0], kFirst);
    ASSERT_EQ(raw->cloud.normals.size(), 1U);
    EXPECT_EQ(raw->cloud.normals[0], Vector3d::UnitZ());
    ASSERT_EQ(raw->cloud.sigma_mm.size(), 1U);
    EXPECT_EQ(raw->cloud.sigma_mm[0], 0.25);
  }
}

/// A heading or a remark that names no columns says nothing of them.
TEST(TextCloudReader, TakesUnnamedColumnsInTheirUsualOrder) {
  for (const char* text : {"foot of Anna\n1.5 -2 3\n4 5 6\n", "2\n1.5 -2 3\n4 5 6\n",
                           "# x y z as the scanner gave them\n1.5 -2 3\n4 5 6\n",
                           "x x y z\n1.5 -2 3\n4 5 6\n", "1.5 -2 3\n4 5 6\n"}) {
    expect_both(text);
  }
}

TEST(TextCloudReader, LosesNoPointToAByteOrderMark) {
  expect_both(
      "\xEF\xBB\xBF"
      "1.5 -2 3\n4 5 6\n");
  expect_both(
      "\xEF\xBB\xBF"
      "y,z,x\n-2,3,1.5\n5,6,4\n");
  EXPECT_TRUE(
      looks_like_text_cloud("\xEF\xBB\xBF"
                            "1.5 -2 3\n"));
}

TEST(TextCloudReader, RefusesLinesThatAreNotAsTheHeadingSays) {
  const auto more = read_text_cloud("x,y,z\n1,2,3,0,0,1\n", "t.csv");
  ASSERT_FALSE(more);
  EXPECT_NE(more.error().line().find("line 2 of t.csv has 6 numbers, its heading 3"),
            std::string::npos)
      << more.error().line();
  const auto fewer = read_text_cloud("x,y,z,q\n1,2,3,4\n1,2,3\n", "t.csv");
  ASSERT_FALSE(fewer);
  EXPECT_NE(fewer.error().message.find("line 3"), std::string::npos);
  const auto unknown = read_text_cloud("id,east,north,up\n1,2,3,4\n", "t.csv");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("names no x, y and z"), std::string::npos);
  EXPECT_NE(unknown.error().advice.find("sigma_mm"), std::string::npos);
}

/// As scanners export them: intensities, colours.
TEST(TextCloudReader, TakesTheFirstThreeOfManyUnnamedColumnsAndSaysSo) {
  for (const char* text :
       {"1.5 -2 3 0.7\n4 5 6 0.8\n", "2\n1.5 -2 3 -900 9 9 9\n4 5 6 -800 8 8 8\n",
        "foot of Anna\n1.5,-2,3,9,9\n4,5,6,9,9\n"}) {
    expect_both(text);
    const auto raw = read_text_cloud(text, "t.csv");
    ASSERT_EQ(raw->notes.size(), 1U) << text;
    EXPECT_NE(raw->notes[0].find("the others were not used"), std::string::npos) << raw->notes[0];
    EXPECT_FALSE(raw->cloud.has_normals());
  }
  for (const char* text : {"1 2 3\n", "1 2 3 0 0 1\n", "# x y z intensity\n1 2 3 4\n"}) {
    EXPECT_TRUE(read_text_cloud(text, "t.csv")->notes.empty()) << text;
  }
}

TEST(TextCloudReader, TakesNamesWithTheirUnit) {
  const auto raw = read_text_cloud("x_mm,y_mm,z_mm,sigma_mm\n1.5,-2,3,0.25\n", "t.csv");
  ASSERT_TRUE(raw) << raw.error().line();
  EXPECT_EQ(raw->cloud.positions[0], kFirst);
  EXPECT_EQ(raw->cloud.sigma_mm, std::vector<double>{0.25});
  EXPECT_TRUE(raw->notes.empty());
}

TEST(TextCloudReader, SaysThatNoiseWithoutAUnitIsNotUsed) {
  const auto raw = read_text_cloud("x,y,z,sigma\n1.5,-2,3,0.25\n", "t.csv");
  ASSERT_TRUE(raw) << raw.error().line();
  EXPECT_FALSE(raw->cloud.has_sigma());
  ASSERT_EQ(raw->notes.size(), 1U);
  EXPECT_NE(raw->notes[0].find("name it sigma_mm"), std::string::npos) << raw->notes[0];
}

TEST(TextCloudReader, NamesTheWordThatIsNoNumber) {
  const std::string text = "\"x\",\"y\",\"z\",\"name\"\n1,2,3,\"heel\"\n4,5,6,\"toe\"\n";
  EXPECT_TRUE(looks_like_text_cloud(text));
  const auto raw = read_text_cloud(text, "t.csv");
  ASSERT_FALSE(raw);
  EXPECT_NE(raw.error().message.find("line 2 of t.csv holds \"heel\", which is no number"),
            std::string::npos)
      << raw.error().line();
  EXPECT_FALSE(looks_like_text_cloud("Dear x, y, z,\nhow are you?\nYours\n"));
}

}  // namespace
}  // namespace instep
