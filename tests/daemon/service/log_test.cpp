#include "daemon/service/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace instep {
namespace {

std::string logged(void (*log)(const std::string&), const std::string& line) {
  testing::internal::CaptureStderr();
  log(line);
  return testing::internal::GetCapturedStderr();
}

/// To put another logger in its place would end the old one, which other threads may be using. A
/// new one would write for the journal here.
TEST(Log, StaysWhenItsLevelIsSet) {
  ::unsetenv("JOURNAL_STREAM");
  set_up_log(LogLevel::kInfo);
  ::setenv("JOURNAL_STREAM", "8:1", 1);
  set_log_level(LogLevel::kError);
  EXPECT_EQ(logged(log_info, "line"), "");
  EXPECT_THAT(logged(log_error, "line"), testing::EndsWith(" error: line\n"));
  ::unsetenv("JOURNAL_STREAM");
  set_log_level(LogLevel::kInfo);
  EXPECT_THAT(logged(log_info, "line"), testing::EndsWith(" info: line\n"));
}

/// What came back after it was over was never told again.
TEST(LastingThings, AreNewsOnceForAsLongAsTheyLast) {
  using testing::ElementsAre;
  using testing::IsEmpty;
  LastingThings things;
  const LastingThing late{"late", "it is late"};
  const LastingThing tilted{"tilted", "it is tilted"};
  const LastingThing dark{"dark", "it is dark"};
  EXPECT_THAT(things.news({late, tilted}), ElementsAre(late.line, tilted.line));
  EXPECT_THAT(things.news({tilted, dark, late}), ElementsAre(dark.line));
  EXPECT_THAT(things.news({}), IsEmpty());
  EXPECT_TRUE(things.empty());
  EXPECT_THAT(things.news({late}), ElementsAre(late.line));
  things.add(dark.name);
  EXPECT_THAT(things.news({late, dark}), IsEmpty());
  EXPECT_THAT(things.news({{late.name, "it is later yet"}, dark}), IsEmpty());
}

}  // namespace
}  // namespace instep
