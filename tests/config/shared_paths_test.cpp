#include "config/shared_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace instep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(SharedPaths, AreToldWhereOnlyOneOfThemCanBe) {
  Settings settings;
  EXPECT_EQ(warning_of_shared_paths(settings), "") << "the defaults";
  settings.pedal.kind = PedalKind::kSimulated;
  settings.store.root = "/tmp/one";
  settings.control.socket = "/tmp/two/../one";
  settings.pedal.fifo = "/tmp/one";
  EXPECT_THAT(warning_of_shared_paths(settings),
              AllOf(HasSubstr("store.root, control.socket, pedal.fifo are all /tmp/one")));
}

TEST(SharedPaths, DoNotMatterWhereThereIsNoSimulatedPedal) {
  Settings settings;
  settings.pedal.kind = PedalKind::kGpio;
  settings.pedal.fifo = settings.control.socket;
  EXPECT_EQ(warning_of_shared_paths(settings), "");
}

}  // namespace
}  // namespace instep
