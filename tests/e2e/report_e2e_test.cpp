#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/foot_body.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ReportOfACloud : public testing::Test {
 protected:
  ReportOfACloud() {
    std::ofstream cloud(folder_.path() / "foot.xyz");
    for (const auto& point : test::FootBody{}.points().positions) {
      cloud << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
    }
  }

  test::ProgramRun measure(const std::string& report) {
    return test::run_program(
        "instep", {"measure", folder_.path() / "foot.xyz", "--report", report, "--format", "csv"});
  }

  static std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  test::TemporaryFolder folder_;
};

TEST_F(ReportOfACloud, IsWrittenBesideTheMeasures) {
  const auto file = folder_.path() / "foot.svg";
  const auto run = measure(file);
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_THAT(run.output, StartsWith("side,id,value_mm"));
  EXPECT_THAT(bytes_of(file), StartsWith("<svg"));
  EXPECT_THAT(bytes_of(file), HasSubstr("foot.xyz"));
  const auto as_pdf = measure(folder_.path() / "foot.pdf");
  if (as_pdf.exit_code != 0) {
    EXPECT_THAT(as_pdf.errors, HasSubstr("librsvg2-bin"));
    GTEST_SKIP() << as_pdf.errors;
  }
  EXPECT_THAT(bytes_of(folder_.path() / "foot.pdf"), StartsWith("%PDF-"));
}

TEST_F(ReportOfACloud, IsWrittenOfAFileWhoseNameIsNoUtf8) {
  const auto cloud = folder_.path() / "M\xFCller.xyz";
  std::filesystem::rename(folder_.path() / "foot.xyz", cloud);
  const auto file = folder_.path() / "foot.svg";
  const auto run = test::run_program("instep", {"measure", cloud, "--report", file});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_THAT(bytes_of(file), HasSubstr("M\xEF\xBF\xBDller.xyz"));
}

TEST_F(ReportOfACloud, SaysWhatIsWrongWithItsName) {
  const auto odd = measure(folder_.path() / "foot.doc");
  EXPECT_EQ(odd.exit_code, 2);
  EXPECT_THAT(odd.errors, HasSubstr(".svg or .pdf"));
  const auto nowhere = measure(folder_.path() / "no/such/foot.svg");
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_EQ(nowhere.output, "");
}

}  // namespace
}  // namespace instep
