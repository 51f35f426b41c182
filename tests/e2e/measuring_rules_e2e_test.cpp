#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/foot_body.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

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

TEST_F(ChosenRules, OfNamedSettingsThatAreUnsoundAreNotPassedOver) {
  for (const auto* settings :
       {"[measures]\naxis = \"brannok\"\n", "[measure]\naxis = \"brannock\"\n",
        "[measures]\naxis = \"brannock\"\n[sizes]\nallowance_mm = -1\n", "[measures\n"}) {
    const auto run = measure(settings, {});
    EXPECT_EQ(run.exit_code, 1) << settings;
    EXPECT_TRUE(run.output.empty()) << run.output;
    EXPECT_NE(run.errors.find("instep.toml"), std::string::npos) << run.errors;
  }
}

TEST_F(ChosenRules, DoNotNeedTheRestOfTheSettings) {
  for (const auto* rest : {"[capture]\nwarmup_frames = -1\n", "[pedal]\nkind = \"gpio\"\n",
                           "[[camera]]\nkind = \"v4l2\"\n", "[station]\nnmae = \"Bern\"\n"}) {
    const auto run = measure(std::string("[measures]\naxis = \"brannock\"\n") + rest, {});
    ASSERT_EQ(run.exit_code, 0) << run.errors;
    EXPECT_EQ(run.errors, "");
    EXPECT_EQ(json::parse(run.output)["axis"], "brannock");
  }
}

// A copy of the program finds them where it is, as an installed one does.
TEST_F(ChosenRules, OfFoundSettingsThatAreUnsoundGiveWayToTheUsualOnesWithAWarning) {
  if (fs::exists("/etc/instep/instep.toml")) GTEST_SKIP() << "this machine has settings of its own";
  ::unsetenv("INSTEP_CONFIG");
  fs::create_directories(folder_.path() / "bin");
  fs::create_directories(folder_.path() / "etc/instep");
  fs::copy(test::built_programs() / "instep", folder_.path() / "bin/instep");
  const auto settings = folder_.path() / "etc/instep/instep.toml";
  const auto shown = [&](const std::string& toml) {
    std::ofstream(settings) << toml;
    return test::run_program(folder_.path() / "bin/instep",
                             {"measure", folder_.path() / "foot.xyz", "--format", "json"});
  };
  const auto unsound = shown("[measures]\naxis = \"brannok\"\nball_girth = 3\n");
  ASSERT_EQ(unsound.exit_code, 0) << unsound.errors;
  EXPECT_EQ(json::parse(unsound.output)["axis"], "pt_toe2");
  EXPECT_THAT(unsound.errors, testing::AllOf(testing::StartsWith("instep: measures by the usual"),
                                             testing::HasSubstr(settings.string() + ":2: "),
                                             testing::HasSubstr("instepd --check")));
  EXPECT_EQ(std::count(unsound.errors.begin(), unsound.errors.end(), '\n'), 1) << unsound.errors;
  const auto sound = shown("[measures]\naxis = \"brannock\"\n[pedal]\nkind = 3\n");
  EXPECT_EQ(sound.errors, "");
  EXPECT_EQ(json::parse(sound.output)["axis"], "brannock");
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
