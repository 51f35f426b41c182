#include "daemon/command_line/own_input.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

TEST(OwnInput, IsSparedByWhateverName) {
  const test::TemporaryFolder folder;
  const auto input = folder.path() / "foot.svg";
  std::ofstream(input) << "0 0 0\n";
  const auto link = folder.path() / "link.svg";
  std::filesystem::create_symlink(input, link);
  for (const auto& out : {input, link, folder.path() / "." / "foot.svg"}) {
    const auto spared = spare_input(out, "--report", input, "the cloud");
    ASSERT_FALSE(spared) << out;
    EXPECT_NE(spared.error().line().find("is the cloud itself"), std::string::npos);
    EXPECT_NE(spared.error().line().find("choose another --report"), std::string::npos);
  }
  EXPECT_TRUE(spare_input(folder.path() / "new.svg", "--report", input, "the cloud"));
  EXPECT_TRUE(spare_input("", "--report", input, "the cloud")) << "none is asked for";
  EXPECT_TRUE(spare_input(input, "--report", folder.path() / "none", "the cloud"));
}

}  // namespace
}  // namespace instep
