#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace instep {
namespace {

using testing::HasSubstr;

TEST(OpenniProgram, RefusesASizeThatIsNone) {
  for (const char* size : {"640x480junk", "-640x480", "640x-480", "640x", "x480", "640", "0x480",
                           "640x99999999999", " 640x480", ""}) {
    const auto run = test::run_program("instep-openni", {"--capture", "--size", size});
    EXPECT_EQ(run.exit_code, 2) << size;
    EXPECT_THAT(run.errors, HasSubstr("--capture")) << size;
  }
  EXPECT_EQ(test::run_program("instep-openni", {"--capture", "--serial"}).exit_code, 2);
}

TEST(OpenniProgram, SaysWhyItCannotCaptureForWhoIsNotInstepd) {
  const auto run = test::run_program("instep-openni", {"--capture", "--size", "640x480"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.errors, HasSubstr("the shared memory is not that of a frame ring"));
}

}  // namespace
}  // namespace instep
