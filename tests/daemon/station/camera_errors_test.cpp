#include "daemon/station/camera_errors.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

TEST(CameraErrors, NameACameraOnce) {
  const auto named = [](const char* message) {
    return named_after_camera("left", {ErrorCode::kIo, Remedy::kRetry, message, ""}).message;
  };
  EXPECT_EQ(named("it left"), "camera left: it left");
  EXPECT_EQ(named("camera left is not there"), "camera left is not there");
  EXPECT_EQ(named("camera left: it left"), "camera left: it left");
  EXPECT_EQ(named("camera leftmost is not there"), "camera left: camera leftmost is not there");
}

}  // namespace
}  // namespace instep
