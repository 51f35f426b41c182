#include "daemon/command_line/doctor/closed_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/stranger.h"

namespace instep {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Whoever had no rights of their own was told that the station was wrong, and to take some.
TEST(ClosedCheck, IsWrongForTheUserOfTheDaemonAlone) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs the right to become another user";
  const auto check = [](std::optional<uid_t> daemon) {
    return test::as_stranger([daemon] {
      return closed_check("camera", "it cannot be opened", "join its group", daemon);
    });
  };
  const auto own = check(test::kStranger);
  EXPECT_TRUE(own.is_wrong());
  EXPECT_EQ(own.finding, "it cannot be opened");
  EXPECT_EQ(own.remedy, "join its group");
  const auto of_another = check(0);
  EXPECT_FALSE(of_another.is_wrong());
  EXPECT_FALSE(of_another.good);
  EXPECT_EQ(of_another.finding, "not looked at: it cannot be opened");
  EXPECT_EQ(of_another.remedy, "sudo -u root instep doctor");
  const auto without = check(std::nullopt);
  EXPECT_TRUE(without.unseen);
  EXPECT_EQ(without.remedy, installed_user() ? "sudo -u instep instep doctor" : "join its group");
}

TEST(ClosedCheck, IsMadeOfWhatFailsForWantOfRightsAlone) {
  const auto closed = failed_check(
      "pedal", {ErrorCode::kPermissionDenied, Remedy::kOperator, "it may not be opened", "join"});
  EXPECT_TRUE(closed.unseen);
  EXPECT_THAT(closed.finding, StartsWith("not looked at: it may not"));
  const auto held =
      failed_check("pedal", {ErrorCode::kBusy, Remedy::kOperator, "it is held", "let go"});
  EXPECT_TRUE(held.is_wrong());
  EXPECT_EQ(held.finding, "it is held");
  EXPECT_EQ(held.remedy, "let go");
}

}  // namespace
}  // namespace instep
