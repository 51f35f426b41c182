#include <gpiod.h>
#include <gtest/gtest.h>

namespace instep {
namespace {

/// The two major versions of the library answer to the same name and share no call. Which one
/// the build was configured with, and says, is the one that is loaded here.
TEST(GpioLibrary, IsOfTheVersionThatTheBuildWasConfiguredWith) {
  EXPECT_STREQ(gpiod_version_string(), INSTEP_GPIOD_VERSION);
  EXPECT_EQ(gpiod_version_string()[0], '1');
}

}  // namespace
}  // namespace instep
