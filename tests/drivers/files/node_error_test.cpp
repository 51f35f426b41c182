#include "drivers/files/node_error.h"

#include <gtest/gtest.h>

#include <cerrno>

namespace instep {
namespace {

TEST(NodeError, TellsAForbiddenNodeFromOneThatIsAwayAndKnowsNoMore) {
  for (const int forbidden : {EACCES, EPERM}) {
    const auto error = node_error(forbidden, "/dev/video0", "join the group", "plug it in");
    ASSERT_TRUE(error) << forbidden;
    EXPECT_EQ(error->code, ErrorCode::kPermissionDenied);
    EXPECT_EQ(error->advice, "join the group");
    EXPECT_EQ(error->message.rfind("/dev/video0 cannot be opened: ", 0), 0U) << error->message;
  }
  for (const int away : {ENOENT, ENOTDIR, ENODEV, ENXIO}) {
    const auto error = node_error(away, "/dev/video0", "join the group", "plug it in");
    ASSERT_TRUE(error) << away;
    EXPECT_EQ(error->code, ErrorCode::kNotFound);
    EXPECT_EQ(error->advice, "plug it in");
  }
  for (const int other : {EBUSY, EMFILE, EIO}) {
    EXPECT_FALSE(node_error(other, "/dev/video0", "join the group", "plug it in")) << other;
  }
}

}  // namespace
}  // namespace instep
