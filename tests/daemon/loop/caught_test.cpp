#include "daemon/loop/caught.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace instep {
namespace {

TEST(Caught, IsWhatTheWorkReturns) {
  EXPECT_EQ(caught("it", [] { return Result<int>(3); }).value(), 3);
  const auto refused =
      caught("it", []() -> Result<int> { return fail(ErrorCode::kTimeout, "late", "wait"); });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kTimeout);
}

TEST(Caught, IsAnErrorWhereTheWorkThrows) {
  const auto full = caught("it", []() -> Result<void> { throw std::bad_alloc(); });
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().remedy, Remedy::kRetry);
  EXPECT_NE(full.error().line().find("not enough memory"), std::string::npos);
  const auto broken = caught("it", []() -> Result<void> { throw std::runtime_error("why"); });
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().remedy, Remedy::kBug);
  EXPECT_EQ(broken.error().message, "it broke off: why");
  EXPECT_FALSE(caught("it", []() -> Result<void> { throw 3; }));
}

}  // namespace
}  // namespace instep
