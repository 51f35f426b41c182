#include "daemon/store/result_content.h"

#include <gtest/gtest.h>

#include "daemon/report/result_json.h"

namespace instep {
namespace {

// Its truth was written over with more digits than any other number has.
TEST(ResultContent, HoldsWhatResultJsonSaysAndNothingElse) {
  ScanRecord record;
  record.id = "20261121T091502417Z-k3f9";
  record.truth = {{"foot_length", 250.12345678}};
  const auto content = content_of(record);
  ASSERT_TRUE(content);
  EXPECT_EQ(Json::parse(content->result_json), result_json(record));
}

}  // namespace
}  // namespace instep
