#include "core/error_names.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

TEST(ErrorNames, AreReadAsTheyAreWritten) {
  for (int i = 0; i <= static_cast<int>(ErrorCode::kInternal); ++i) {
    const auto code = static_cast<ErrorCode>(i);
    EXPECT_EQ(error_code_from(to_string(code)), code);
  }
  for (int i = 0; i <= static_cast<int>(Remedy::kBug); ++i) {
    const auto remedy = static_cast<Remedy>(i);
    EXPECT_EQ(remedy_from(to_string(remedy)), remedy);
  }
}

TEST(ErrorNames, AreNoOthers) {
  for (const auto* name : {"", "IO", "io ", "nothing"}) {
    EXPECT_FALSE(error_code_from(name)) << name;
    EXPECT_FALSE(remedy_from(name)) << name;
  }
}

}  // namespace
}  // namespace instep
