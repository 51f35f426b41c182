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

/// A table has no column for it, and nothing said that the unit was a guess.
TEST(OutputFormat, OfATableLeavesWhatIsSaidOfTheFootToTheErrors) {
  const test::TemporaryFolder folder;
  std::ofstream cloud(folder.path() / "foot.xyz");
  for (const auto& point : test::FootBody{}.points().positions) {
    cloud << point.x() / 10 << ' ' << point.y() / 10 << ' ' << point.z() / 10 << '\n';
  }
  cloud.close();
  const auto table = test::run_program(
      "instep", {"measure", folder.path() / "foot.xyz", "--unit", "auto", "--format", "csv"});
  EXPECT_EQ(table.exit_code, 0) << table.errors;
  EXPECT_THAT(table.output, testing::StartsWith("side,id,"));
  EXPECT_THAT(table.errors, HasSubstr("taken to be cm"));
}

json girth_of(const std::filesystem::path& file, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"girth", file, "--plane=130,0,0,130,10,0,130,0,10"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const auto run = test::run_program("instep", arguments);
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  return json::parse(run.output);
}

TEST(OutputFormat, OfAGirthSaysWhereTheNoiseThatWasGivenIsNotUsed) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "foot.csv";
  std::ofstream cloud(file);
  cloud << "x,y,z,sigma_mm\n";
  for (const auto& point : test::FootBody{}.points().positions) {
    cloud << point.x() << ',' << point.y() << ',' << point.z() << ",0.25\n";
  }
  cloud.close();
  const auto told = girth_of(file, {"--sigma-mm", "2"});
  EXPECT_NEAR(told.at("sigma_mm").get<double>(), 0.25, 1e-9);
  EXPECT_THAT(told.at("warnings").dump(), HasSubstr("--sigma-mm was not used"));
  EXPECT_THAT(girth_of(file, {}).at("warnings").dump(), Not(HasSubstr("--sigma-mm")));
  const auto hull = girth_of(file, {"--sigma-mm", "2", "--method", "hull"});
  EXPECT_EQ(hull.at("sigma_mm").get<double>(), 0.0);
  EXPECT_THAT(hull.at("warnings").dump(), HasSubstr("knows no noise"));
}

TEST(OutputFormat, IsToldAlikeByEveryHelp) {
  for (const char* command : {"measure", "girth", "replay", "repeat", "devices"}) {
    const auto help = test::run_program("instep", {command, "--help"});
    EXPECT_THAT(help.output, HasSubstr("json (if stdout is no terminal)")) << command;
  }
}

}  // namespace
}  // namespace instep
