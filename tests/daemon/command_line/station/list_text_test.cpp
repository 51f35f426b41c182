#include "daemon/command_line/station/list_text.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <time.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace instep {
namespace {

using nlohmann::json;

constexpr const char* kId = "20261121T231502417Z-k3f9";

/// As in a shop two hours east of Greenwich.
class ListText : public testing::Test {
 protected:
  ListText() {
    if (const char* zone = ::getenv("TZ")) before_ = zone;
    zone("UTC-2");
  }
  ~ListText() override { before_ ? zone(before_->c_str()) : zone(nullptr); }

 private:
  static void zone(const char* name) {
    name != nullptr ? ::setenv("TZ", name, 1) : ::unsetenv("TZ");
    ::tzset();
  }
  std::optional<std::string> before_;
};

TEST_F(ListText, TellsWhatAPersonKnowsAScanBy) {
  const json result{
      {"side", "left"},
      {"simulated", true},
      {"warnings", {"one"}},
      {"withheld", {{{"id", "arch_height"}}, {{"id", "toe1_height"}}}},
      {"measures",
       {{{"id", "foot_length"}, {"value_mm", 253.14}, {"u95_mm", 0.46}, {"warnings", {"two"}}},
        {{"id", "ball_girth"}, {"value_mm", 241.0}, {"u95_mm", nullptr}}}}};
  EXPECT_EQ(list_line(kId, result),
            "20261121T231502417Z-k3f9  2026-11-22 01:15  left   length 253.1 +-0.5 mm   "
            "ball 241.0 mm         2 notes, 2 measures withheld, simulated\n");
}

TEST_F(ListText, TellsWhatIsMissing) {
  const std::string bare =
      "20261121T231502417Z-k3f9  2026-11-22 01:15  ?      no length               no ball          "
      "     no note\n";
  for (const char* result : {"{}", "null", "[]", R"({"side":3,"measures":[7,{"id":"ball_girth"}]})",
                             R"({"measures":{"id":1},"withheld":"x","simulated":"y"})",
                             R"({"side":"\u001b[2J","measures":[
                                 {"id":"foot_length","value_mm":1e300},
                                 {"id":"ball_girth","value_mm":-1e5}]})"}) {
    EXPECT_EQ(list_line(kId, json::parse(result)), bare) << result;
  }
  const auto without_interval = json::parse(
      R"({"side":"right","measures":[{"id":"foot_length","value_mm":250,"u95_mm":1e9}]})");
  EXPECT_NE(list_line(kId, without_interval).find("right  length 250.0 mm "), std::string::npos);
  EXPECT_EQ(list_line_without_result("20261399T231502417Z-k3f9", "it is damaged"),
            "20261399T231502417Z-k3f9  no such date       it is damaged\n");
}

}  // namespace
}  // namespace instep
