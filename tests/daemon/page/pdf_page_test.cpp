#include "daemon/page/pdf_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "daemon/page/report_page.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::HasSubstr;

/// Puts a program of the name rsvg-convert before the real one, or takes all away.
class PdfPage : public testing::Test {
 protected:
  PdfPage() : path_(std::getenv("PATH")) {}
  ~PdfPage() override { ::setenv("PATH", path_.c_str(), 1); }

  void look_only_here(const std::string& script) {
    const auto program = folder_.path() / "rsvg-convert";
    if (!script.empty()) {
      std::ofstream(program) << "#!/bin/sh\n" << script;
      ASSERT_EQ(::chmod(program.c_str(), 0700), 0);
    }
    ::setenv("PATH", folder_.path().c_str(), 1);
  }

  test::TemporaryFolder folder_;
  std::string path_;
};

TEST_F(PdfPage, IsAPageOfPdf) {
  const auto pdf = pdf_of_page(report_page(ScanRecord{}));
  if (!pdf && pdf.error().code == ErrorCode::kUnsupported) GTEST_SKIP() << pdf.error().line();
  ASSERT_TRUE(pdf) << pdf.error().line();
  EXPECT_TRUE(pdf->starts_with("%PDF-"));
  EXPECT_THAT(pdf->substr(pdf->size() - 16), HasSubstr("%%EOF"));
}

TEST_F(PdfPage, SaysWhichPackageIsMissing) {
  look_only_here("");
  const auto pdf = pdf_of_page("<svg/>");
  ASSERT_FALSE(pdf);
  EXPECT_EQ(pdf.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(pdf.error().line(), HasSubstr("librsvg2-bin"));
}

TEST_F(PdfPage, HandsThePageOverAndTakesWhatComes) {
  look_only_here("printf '%%PDF-1.5 of '; while read -r line; do printf '%s' \"$line\"; done");
  const auto pdf = pdf_of_page("<svg/>\n");
  ASSERT_TRUE(pdf) << pdf.error().line();
  EXPECT_EQ(*pdf, "%PDF-1.5 of <svg/>");
}

TEST_F(PdfPage, FailsWithAProgramThatFails) {
  for (const char* script :
       {"exit 1", "printf '%%PDF-1.5'; exit 1", "echo no", ":", "kill -9 $$"}) {
    look_only_here(script);
    const auto pdf = pdf_of_page("<svg/>");
    ASSERT_FALSE(pdf) << script;
    EXPECT_EQ(pdf.error().code, ErrorCode::kIo);
  }
}

}  // namespace
}  // namespace instep
