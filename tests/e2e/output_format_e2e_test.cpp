#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/foot_body.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::vector<std::vector<std::string>> commands_with_results(const std::filesystem::path& folder) {
  std::ofstream cloud(folder / "foot.xyz");
  for (const auto& point : test::FootBody{}.points().positions) {
    cloud << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
  }
  const auto made =
      test::run_program("instep", {"simulate", "--out", folder / "visit", "--frames", "1"});
  EXPECT_EQ(made.exit_code, 0) << made.errors;
  return {{"measure", folder / "foot.xyz"},
          {"girth", folder / "foot.xyz", "--plane=130,0,0,130,10,0,130,0,10"},
          {"replay", folder / "visit"},
          {"devices"}};
}

TEST(OutputFormat, IsTextInATerminalAndJsonInAPipe) {
  const test::TemporaryFolder folder;
  for (const auto& command : commands_with_results(folder.path())) {
    const auto piped = test::run_program("instep", command);
    ASSERT_EQ(piped.exit_code, 0) << command[0] << ": " << piped.errors;
    EXPECT_TRUE(json::accept(piped.output)) << command[0];
    const auto shown = test::run_program("instep", command, test::Stdout::kTerminal);
    EXPECT_EQ(shown.exit_code, 0) << command[0] << ": " << shown.errors;
    EXPECT_GT(shown.output.size(), 40U) << command[0];
    EXPECT_THAT(shown.output, Not(HasSubstr("{"))) << command[0];
  }
}

TEST(OutputFormat, IsToldAlikeByEveryHelp) {
  for (const char* command : {"measure", "girth", "replay", "repeat", "devices"}) {
    const auto help = test::run_program("instep", {command, "--help"});
    EXPECT_THAT(help.output, HasSubstr("json (if stdout is no terminal)")) << command;
  }
}

}  // namespace
}  // namespace instep
