#include "drivers/openni2/openni_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/run_program.h"
#include "tests/support/signal_rain.h"
#include "tests/support/temporary_folder.h"

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

// A signal led past the limit, into reading what nobody writes.
TEST(OpenniProgram, ListsNoLongerThanItsLimitHoweverManySignalsCome) {
  const test::TemporaryFolder folder;
  const auto silent = folder.path() / "silent";
  std::ofstream(silent) << "#!/bin/sh\nexec sleep 2\n";
  std::filesystem::permissions(silent, std::filesystem::perms::owner_all);
  const test::SignalRain rain;
  const auto list = list_openni_devices({silent, {}}, std::chrono::milliseconds(200));
  ASSERT_FALSE(list);
  EXPECT_EQ(list.error().code, ErrorCode::kTimeout) << list.error().line();
}

}  // namespace
}  // namespace instep
