#include "daemon/command_line/doctor/output_look.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <string>

namespace instep {
namespace {

using namespace std::chrono_literals;

OutputSettings outputs(const std::string& line) {
  OutputSettings settings;
  settings.ready_lamp.emplace().place.line = line;
  return settings;
}

TEST(OutputLook, FindsThoseThatAreThereAndWhyOthersAreNot) {
  auto both = outputs("green");
  both.projector.emplace().place.line = "light";
  const auto look = [](const GpioOutputSettings& output) -> Result<void> {
    if (output.place.line == "green") return {};
    return fail(ErrorCode::kPermissionDenied, "this user may not open it", "join the group");
  };
  const auto found = look_for_outputs(both, look, 1h);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "lamp.ready");
  EXPECT_EQ(found[0].trouble, "");
  EXPECT_EQ(found[1].name, "projector");
  EXPECT_EQ(found[1].trouble, "this user may not open it");
  EXPECT_EQ(found[1].remedy, "join the group");
  EXPECT_TRUE(found[1].is_closed);
}

// The doctor hung with its driver, and told nothing of all the rest.
TEST(OutputLook, SaysThatOneDoesNotAnswerWhoseDriverHangs) {
  std::promise<void> answering;
  const auto over = std::make_shared<std::promise<void>>();
  const auto look = [until = answering.get_future().share(), over](const GpioOutputSettings&) {
    until.wait();
    over->set_value();
    return Result<void>();
  };
  const auto found = look_for_outputs(outputs("green"), look, 20ms);
  answering.set_value();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].trouble, "it does not answer");
  EXPECT_NE(found[0].remedy, "");
  over->get_future().wait();
}

}  // namespace
}  // namespace instep
