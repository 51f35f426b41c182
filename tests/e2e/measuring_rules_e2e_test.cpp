#include <gtest/gtest.h>

#include <cstdlib>
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

class ChosenRules : public testing::Test {
 protected:
  ChosenRules() {
    std::ofstream cloud(folder_.path() / "foot.xyz");
    for (const auto& point : test::FootBody{}.points().positions) {
      cloud << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
    }
  }
  ~ChosenRules() override { ::unsetenv("INSTEP_CONFIG"); }

  test::ProgramRun measure(const std::string& settings, const std::vector<std::string>& options) {
    const auto file = folder_.path() / "instep.toml";
    std::ofstream(file) << "[[camera]]\nkind = \"simulated\"\n" << settings;
    ::setenv("INSTEP_CONFIG", file.c_str(), 1);
    std::vector<std::string> words{"measure", folder_.path() / "foot.xyz", "--format", "json"};
    words.insert(words.end(), options.begin(), options.end());
    return test::run_program("instep", words);
  }

  json result_of(const std::string& settings, const std::vector<std::string>& options = {}) {
    const auto run = measure(settings, options);
    EXPECT_EQ(run.exit_code, 0) << run.errors;
    return json::parse(run.output);
  }

  test::TemporaryFolder folder_;
};

TEST_F(ChosenRules, AreThoseOfTheSettingsUnlessSaidOtherwise) {
  const json usual = result_of("");
  EXPECT_EQ(usual["axis"], "pt_toe2");
  EXPECT_EQ(usual["warnings"].dump().find("definitions"), std::string::npos);
  EXPECT_EQ(usual["sizes"].dump().find("definitions"), std::string::npos);
  const std::string settings = "[measures]\naxis = \"brannock\"\nheel_breadth = \"40mm\"\n";
  EXPECT_EQ(result_of(settings)["axis"], "brannock");
  const json said = result_of(settings, {"--axis", "pca"});
  EXPECT_EQ(said["axis"], "pca");
  EXPECT_NE(said["warnings"].dump().find("axis pca, ball girth upright"), std::string::npos);
  EXPECT_NE(said["sizes"].dump().find("usual definitions"), std::string::npos);
  for (const auto& measure : said["measures"]) {
    if (measure["id"] != "heel_breadth") continue;
    EXPECT_NE(measure["definition"].get<std::string>().find("40 mm"), std::string::npos);
  }
}

TEST_F(ChosenRules, OfUnsoundSettingsAreNotPassedOver) {
  for (const auto* settings :
       {"[measures]\naxis = \"brannok\"\n",
        "[measures]\naxis = \"brannock\"\n[capture]\nwarmup_frames = -1\n"}) {
    const auto run = measure(settings, {});
    EXPECT_EQ(run.exit_code, 1) << settings;
    EXPECT_TRUE(run.output.empty()) << run.output;
    EXPECT_NE(run.errors.find("instep.toml"), std::string::npos) << run.errors;
  }
}

TEST_F(ChosenRules, NeedNoCalibration) {
  std::ofstream(folder_.path() / "calibration.toml") << "faulty";
  EXPECT_EQ(result_of("[measures]\naxis = \"brannock\"\n")["axis"], "brannock");
}

TEST_F(ChosenRules, ThatThereAreNoneOfAreRefused) {
  EXPECT_EQ(measure("", {"--axis", "pt_toe3"}).exit_code, 2);
  EXPECT_EQ(measure("", {"--ball-girth", "Upright"}).exit_code, 2);
  EXPECT_EQ(measure("", {"--heel-breadth", "40"}).exit_code, 2);
}

}  // namespace
}  // namespace instep
