#include "daemon/command_line/result_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace instep {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

json result() {
  return {{"id", "20261121T091502417Z-k3f9"},
          {"side", "left"},
          {"measures",
           {{{"id", "foot_length"}, {"value_mm", 251.04}, {"u95_mm", 0.62}},
            {{"id", "ball_girth"}, {"value_mm", 240.0}, {"warnings", {"few points"}}}}}};
}

TEST(ResultText, SaysEachMeasureWithItsInterval) {
  const auto text = result_text(result());
  EXPECT_THAT(text, HasSubstr("left foot\n"));
  EXPECT_THAT(text, HasSubstr("  foot_length                  251.0 mm    +-0.6\n"));
  EXPECT_THAT(text, HasSubstr("  ball_girth                   240.0 mm\n"));
  EXPECT_THAT(text, HasSubstr("note: ball_girth: few points\n"));
  EXPECT_THAT(text, Not(HasSubstr("truth")));
}

TEST(ResultText, PutsTheTruthAndTheErrorBesideAMeasure) {
  auto simulated = result();
  simulated["simulated"] = true;
  simulated["truth"] = {{"foot_length", 250.54}};
  const auto text = result_text(simulated);
  EXPECT_THAT(text, HasSubstr("left foot, simulated\n"));
  EXPECT_THAT(text, HasSubstr("95 %    truth   error\n"));
  EXPECT_THAT(text,
              HasSubstr("  foot_length                  251.0 mm    +-0.6    250.5   +0.50\n"));
}

TEST(ResultText, SaysWhatWasWithheldAndTheSizes) {
  auto partly = result();
  partly["withheld"] = {{{"id", "waist_girth"}, {"reason", "the section is open"}}};
  partly["sizes"] = {{"mondopoint_mm", 250.0}, {"eu", 40.0}};
  const auto text = result_text(partly);
  EXPECT_THAT(text, HasSubstr("  waist_girth                      -    the section is open\n"));
  EXPECT_THAT(text, HasSubstr("  size guide: Mondopoint 250, EU 40\n"));
}

TEST(ResultText, LeavesOutWhatIsOfTheWrongShape) {
  for (const json& odd : {json(), json(3), json::array(), json::object(),
                          json{{"measures", {1, nullptr, {{"id", 5}}}}, {"truth", "none"}},
                          json{{"withheld", {1, {{"id", 5}}}}, {"warnings", "none"}}}) {
    EXPECT_NO_THROW(static_cast<void>(result_text(odd)));
  }
}

}  // namespace
}  // namespace instep
