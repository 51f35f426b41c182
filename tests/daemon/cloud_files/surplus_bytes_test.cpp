// Files that go on after the points that their header names: of those that were read nothing is
// wrong, but maybe some are missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "daemon/cloud_files/cloud_file.h"
#include "daemon/cloud_files/text_tokens.h"

namespace instep {
namespace {

const std::string kAscii =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n0 0 0\n100 20 30\n";
const std::string kBinary =
    "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty uchar x\n"
    "property uchar y\nproperty uchar z\nend_header\nABCabc";
const std::string kAsciiPcd =
    "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
    "POINTS 2\nDATA ascii\n0 0 0\n100 20 30\n";
const std::string kBinaryPcd =
    "VERSION 0.7\nFIELDS x y z\nSIZE 1 1 1\nTYPE U U U\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
    "POINTS 2\nDATA binary\nABCabc";

/// What is said of bytes that were not read.
std::string told(const std::string& bytes, const char* name) {
  const auto file = read_cloud_bytes(bytes, name, LengthUnit::kMillimetre);
  if (!file) return file.error().line();
  const auto note = std::find_if(file->notes.begin(), file->notes.end(), [](const auto& one) {
    return one.find("goes on for") != std::string::npos;
  });
  return note == file->notes.end() ? "" : *note;
}

TEST(SurplusBytes, AreToldOf) {
  EXPECT_NE(told(kAscii + "1 2 3\n", "a.ply").find("for 6 bytes after all"), std::string::npos);
  EXPECT_NE(told(kBinary + "DEF", "a.ply").find("for 3 bytes after all"), std::string::npos);
  EXPECT_NE(told(kAsciiPcd + "1 2 3\n", "a.pcd").find("for 6 bytes"), std::string::npos);
  EXPECT_NE(told(kBinaryPcd + "DEF", "a.pcd").find("for 3 bytes"), std::string::npos);
}

TEST(SurplusBytes, AreNoneOfAWholeFileNorBlanks) {
  for (const char* blanks : {"", "\n", " \r\n\n"}) {
    EXPECT_EQ(told(kAscii + blanks, "a.ply"), "");
    EXPECT_EQ(told(kBinary + blanks, "a.ply"), "");
    EXPECT_EQ(told(kAsciiPcd + blanks, "a.pcd"), "");
    EXPECT_EQ(told(kBinaryPcd + blanks, "a.pcd"), "");
  }
  EXPECT_EQ(told(kBinaryPcd + std::string(500, '\0'), "a.pcd"), "");
}

/// They were read word by word, so that a row's last numbers were the next point's first.
TEST(SurplusBytes, OfRowsThatHoldMoreThanTheHeaderNamesAreDamage) {
  std::string rows = kAscii;
  rows.replace(rows.find("0 0 0\n"), 5, "0 0 0 7 7 7");
  std::string pcd_rows = kAsciiPcd;
  pcd_rows.replace(pcd_rows.find("0 0 0\n"), 5, "0 0 0 7 7 7");
  for (const auto& said : {told(rows + "100 20 30 7 7 7\n", "a.ply"), told(pcd_rows, "a.pcd")}) {
    EXPECT_NE(said.find("hold 6 numbers, its header names 3"), std::string::npos) << said;
  }
}

TEST(SurplusBytes, OfAnElementWithoutRowsAreTheNextOnes) {
  std::string file = kAscii;
  const std::string vertices = "element vertex 2\n";
  file.replace(file.find(vertices), vertices.size(),
               "element camera 0\nproperty float f\n" + vertices);
  EXPECT_EQ(told(file, "a.ply"), "");
}

TEST(TextTokens, AreCountedInTheFirstRowThatHasAny) {
  EXPECT_EQ(words_in_first_row("\n \r\n1 2\t3 \n4 5\n"), 3U);
  EXPECT_EQ(words_in_first_row(" \n"), 0U);
  EXPECT_EQ(words_in_first_row(""), 0U);
}

TEST(TextTokens, LoseBlanksAtTheirEnd) {
  EXPECT_EQ(without_blanks_at_end("a b \t\r\n"), "a b");
  EXPECT_EQ(without_blanks_at_end(" \n"), "");
  EXPECT_EQ(without_blanks_at_end(""), "");
}

}  // namespace
}  // namespace instep
