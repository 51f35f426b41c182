#include "config/reading/printable_text.h"

#include <gtest/gtest.h>

#include <string>

namespace instep {
namespace {

TEST(PrintableText, IsOfAnyScript) {
  for (const char* text :
       {"", "Filiale Zürich & Söhne", "足型計測", "مركز القدم", "— … ±", "🦶"}) {
    EXPECT_TRUE(is_printable(text)) << text;
  }
}

// U+202E in a station's name turned the id and the time of a page about.
TEST(PrintableText, HoldsNothingThatTurnsALineAboutOrBreaksIt) {
  for (const char* text : {"a\u202Eb", "\u2067", "a\u200F", "\u061Cb", "a\u2028b", "a\nb", "\x7f",
                           "\u009b31m", "\u0080"}) {
    EXPECT_FALSE(is_printable(text)) << text;
  }
  EXPECT_TRUE(is_printable("\u00A0 \xC2")) << "and what is no UTF-8 is another matter";
}

}  // namespace
}  // namespace instep
