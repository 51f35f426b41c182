#include "daemon/page/paper.h"

#include <gtest/gtest.h>

#include <string>

namespace instep {
namespace {

TEST(TextWidth, IsNoLessThanThatOfAWideType) {
  // The widths that the font file of DejaVu Serif states, summed, for a letter size of 1.
  EXPECT_GE(paper::text_width("WANDERSCHUHE MIT FUSSBETT", 1.0), 18.104);
  EXPECT_GE(paper::text_width("Lowa Renegade GTX women narrow", 1.0), 18.513);
  EXPECT_GE(paper::text_width("Orthopädie-Schuhtechnik Müller & Söhne, Filiale Zürich", 1.0),
            28.860);
  EXPECT_GE(paper::text_width("20261128T193412417Z-k3f9", 1.0), 14.9);
  EXPECT_GE(paper::text_width("ÄÖÜ", 1.0), 2.38);
}

// 64 of them in a station's name pushed the time off the page.
TEST(TextWidth, IsNoLessForTheWidestLettersThatANameMayHave) {
  const auto check = [](const std::string& letter, double width) {
    std::string name;
    for (int i = 0; i < 64; ++i) name += letter;
    EXPECT_GE(paper::text_width(name, 1.0), 64 * width) << letter;
  };
  // As the font file of DejaVu Serif states them.
  check("W", 1.028);
  check("M", 1.024);
  check("m", 0.948);
  check("w", 0.856);
  check("@", 1.0);
  check("%", 0.95);
  check("+", 0.838);
  check("Ж", 1.12);
  check("Œ", 1.14);
  check("—", 1.0);
}

TEST(WrappedText, BreaksAtSpacesAndFitsTheWidth) {
  const std::string text = "no camera saw the sole; it is closed by the platform";
  const auto lines = paper::wrapped(text, 300.0, 20.0);
  ASSERT_GT(lines.size(), 1U);
  std::string joined;
  for (const auto& line : lines) {
    EXPECT_LE(line.size(), 25U);
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, text);
}

TEST(WrappedText, PartsNoNumberFromItsPercent) {
  const std::string text = "taken for a left foot, 99 % sure of it";
  for (double width = 100.0; width < 400.0; width += 4.0) {
    for (const auto& line : paper::wrapped(text, width, 20.0)) EXPECT_NE(line[0], '%') << width;
  }
}

TEST(WrappedText, HasRoomForLettersThatAreAsWideAsTheyAreTall) {
  std::string joined;
  for (const auto& line : paper::wrapped("足型計測ステーション東京本店", 100.0, 20.0)) {
    EXPECT_LE(line.size() / 3, 5U);
    joined += line;
  }
  EXPECT_EQ(joined, "足型計測ステーション東京本店");
  EXPECT_EQ(paper::wrapped("足型", 0.0, 20.0).size(), 2U);
}

TEST(WrappedText, CountsWhatStandsInPlaceOfBytesThatAreNoText) {
  const auto lines = paper::wrapped(std::string(40, '\xBC'), 20.0 * 0.6 * 10.0, 20.0);
  ASSERT_EQ(lines.size(), 8U);
  EXPECT_EQ(lines[0], "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(WrappedText, CutsALongWordBetweenLettersOfUtf8) {
  std::string word;
  for (int i = 0; i < 40; ++i) word += "ö";
  std::string joined;
  for (const auto& line : paper::wrapped(word, 100.0, 20.0)) {
    EXPECT_EQ(line.size() % 2, 0U);
    EXPECT_FALSE(line.empty());
    joined += line;
  }
  EXPECT_EQ(joined, word);
  EXPECT_TRUE(paper::wrapped("", 100.0, 20.0).empty());
  EXPECT_EQ(paper::wrapped("ab", 0.0, 20.0).size(), 2U);
}

}  // namespace
}  // namespace instep
