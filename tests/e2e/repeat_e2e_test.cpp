#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class RepeatProgram : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) {
    fs::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return folder_.path() / name;
  }

  std::string result(const std::string& name, double length_mm) {
    const json measure = {{"id", "foot_length"}, {"value_mm", length_mm}};
    return file(name, json{{"id", name}, {"side", "left"}, {"measures", {measure}}}.dump());
  }

  test::TemporaryFolder folder_;
};

TEST_F(RepeatProgram, TakesFoldersFilesAndWhatReplayPrints) {
  result("one/result.json", 250.0);
  const auto two = result("two.json", 251.0);
  const json third = {{"id", "third"},
                      {"side", "left"},
                      {"measures", {{{"id", "foot_length"}, {"value_mm", 252.0}}}}};
  const auto replayed = file("replay.json", json{{"results", {third}}}.dump());
  const auto plot = (folder_.path() / "plot.svg").string();
  const auto run = test::run_program(
      "instep", {"repeat", folder_.path() / "one", two, replayed, "--plot", plot});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_EQ(run.errors, "");
  const json study = json::parse(run.output);
  EXPECT_EQ(study["feet"][0]["n"], 3);
  EXPECT_EQ(study["feet"][0]["measures"][0]["mean_mm"], 251.0);
  EXPECT_EQ(study["feet"][0]["measures"][0]["sd_mm"], 1.0);
  std::ifstream stream(plot);
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(stream), {}), HasSubstr("</svg>"));
}

TEST_F(RepeatProgram, ReplacesNoResultByItsPlot) {
  const auto one = result("one.svg", 250.0);
  const auto run =
      test::run_program("instep", {"repeat", result("two.json", 251.0), one, "--plot", one});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.errors, HasSubstr("is a result itself"));
}

TEST_F(RepeatProgram, SaysInOneLineWhatIsWrong) {
  const auto good = result("good.json", 250.0);
  const auto other = result("other.json", 251.0);
  const auto expect_failure = [](const std::vector<std::string>& arguments, int exit_code,
                                 const char* said) {
    const auto run = test::run_program("instep", arguments);
    EXPECT_EQ(run.exit_code, exit_code);
    EXPECT_EQ(run.output, "");
    EXPECT_THAT(run.errors, HasSubstr(said));
    EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
  };
  expect_failure({"repeat"}, 2, "RESULT");
  expect_failure({"repeat", good}, 1, "no two different results");
  expect_failure({"repeat", good, folder_.path() / "none"}, 1, "none");
  expect_failure({"repeat", good, file("torn.json", "{\"id\": ")}, 1, "is no JSON object");
  expect_failure({"repeat", good, file("empty.json", "{}")}, 1, "holds no measures");
  expect_failure({"repeat", good, file("deep.json", std::string(100000, '['))}, 1, "no JSON");
  expect_failure({"repeat", good, other, "--plot", good}, 2, "ends in .svg");
  expect_failure({"repeat", good, other, "--plot", folder_.path() / "no/such/plot.svg"}, 1,
                 "no/such");
}

TEST_F(RepeatProgram, TeachesItself) {
  const auto help = test::run_program("instep", {"repeat", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word : {"Examples", "mean |d|", "--plot", "ISO 20685-1"}) {
    EXPECT_THAT(help.output, HasSubstr(word));
  }
}

}  // namespace
}  // namespace instep
