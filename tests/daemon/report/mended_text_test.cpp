#include "daemon/report/mended_text.h"

#include <gtest/gtest.h>

#include <string>

namespace instep {
namespace {

constexpr const char* kInItsPlace = "\xEF\xBF\xBD";  // U+FFFD

TEST(MendedText, LeavesTextAsItIs) {
  for (const char* text : {"", "foot.ply", "Müller & Söhne", "足 \xF0\x9F\xA6\xB6", "a\tb\n\x01"}) {
    EXPECT_EQ(mended_text(text), text);
  }
  const std::string with_zero("a\0b", 3);
  EXPECT_EQ(mended_text(with_zero), with_zero);
}

// As the name of a station in a result of an earlier version.
TEST(MendedText, ReplacesWhatTurnsALineAbout) {
  EXPECT_EQ(mended_text("a\u202Eb"), std::string("a") + kInItsPlace + "b");
}

TEST(MendedText, ReplacesBytesThatAreNoUtf8) {
  EXPECT_EQ(mended_text("M\xFCller"), std::string("M") + kInItsPlace + "ller");
  EXPECT_EQ(mended_text("M\xC3"), std::string("M") + kInItsPlace);
  EXPECT_EQ(mended_text("\xBC"), kInItsPlace);
  // A slash in two bytes, half of a pair of UTF-16, and what is beyond the last character.
  for (const char* bytes : {"\xC0\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80"}) {
    const std::string mended = mended_text(bytes);
    EXPECT_EQ(mended.substr(0, 3), kInItsPlace);
    EXPECT_EQ(mended.find_first_not_of(kInItsPlace), std::string::npos) << mended;
  }
}

TEST(MendedText, ReplacesWhatUnicodeHasNot) {
  EXPECT_EQ(mended_text("a\xEF\xBF\xBE\xEF\xBF\xBFz"),
            std::string("a") + kInItsPlace + kInItsPlace + "z");
}

}  // namespace
}  // namespace instep
