#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/foot_body.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using nlohmann::json;

class SizesOfTheSettings : public testing::Test {
 protected:
  SizesOfTheSettings() {
    std::ofstream cloud(folder_.path() / "foot.xyz");
    for (const auto& point : test::FootBody{}.points().positions) {
      cloud << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
    }
  }
  ~SizesOfTheSettings() override { ::unsetenv("INSTEP_CONFIG"); }

  json sizes_with(const std::string& settings) {
    const auto file = folder_.path() / "instep.toml";
    std::ofstream(file) << "[[camera]]\nkind = \"simulated\"\n" << settings;
    ::setenv("INSTEP_CONFIG", file.c_str(), 1);
    const auto run =
        test::run_program("instep", {"measure", folder_.path() / "foot.xyz", "--format", "json"});
    EXPECT_EQ(run.exit_code, 0) << run.errors;
    return json::parse(run.output).at("sizes");
  }

  test::TemporaryFolder folder_;
};

TEST_F(SizesOfTheSettings, AreThoseOfTheResult) {
  const json plain = sizes_with("");
  EXPECT_EQ(plain["allowance_mm"], 15.0);
  EXPECT_TRUE(plain["shop"].empty());
  const json roomy = sizes_with(
      "[sizes]\nallowance_mm = 25\n[[sizes.shop]]\nname = \"Walker\"\n"
      "sizes = [{ size = \"small\", longest_foot_mm = 250 },\n"
      "{ size = \"large\", longest_foot_mm = 270 }]\n");
  EXPECT_EQ(roomy["allowance_mm"], 25.0);
  // Ten millimetres more of last are one and a half Paris points.
  EXPECT_NEAR(roomy["exact"]["eu"].get<double>() - plain["exact"]["eu"].get<double>(), 1.5, 0.011);
  EXPECT_EQ(roomy["shop"][0]["table"], "Walker");
  EXPECT_EQ(roomy["shop"][0]["size"], "large");
}

}  // namespace
}  // namespace instep
