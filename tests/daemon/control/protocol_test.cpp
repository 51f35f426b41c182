#include "daemon/control/protocol.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace instep {
namespace {

TEST(Protocol, UnderstandsEveryVerb) {
  for (const auto* line :
       {R"({"verb":"scan"})", R"({"verb":"cancel"})", R"({"verb":"status"})", R"({"verb":"watch"})",
        R"({"verb":"list"})", R"({"verb":"show","id":"latest"})", R"({"verb":"export","id":"x"})",
        R"({"verb":"delete","id":"x"})"}) {
    EXPECT_TRUE(parse_request(line)) << line;
  }
}

TEST(Protocol, RefusesWhatIsNoRequest) {
  for (const auto* line :
       {"", " ", "scan", "[]", "null", "{}", "{", R"({"verb":1})", R"({"verb":"fly"})",
        R"({"verb":"show"})", R"({"verb":"scan","id":"x"})", R"({"verb":"delete","id":"latest"})",
        R"({"verb":"show","id":7})", R"({"verb":"scan","force":true})", "\xff\xfe"}) {
    const auto request = parse_request(line);
    ASSERT_FALSE(request) << line;
    EXPECT_EQ(request.error().code, ErrorCode::kInvalidInput) << line;
  }
}

/// A line is refused as documented, or means the same when what was understood is sent again.
void expect_refused_or_whole(const std::string& line) {
  const auto request = parse_request(line);
  if (!request) {
    EXPECT_EQ(request.error().code, ErrorCode::kInvalidInput) << line;
    return;
  }
  nlohmann::json again = {{"verb", request->verb}};
  if (!request->id.empty()) again["id"] = request->id;
  const auto read = parse_request(again.dump());
  ASSERT_TRUE(read) << line;
  EXPECT_EQ(read->verb, request->verb) << line;
  EXPECT_EQ(read->id, request->id) << line;
}

TEST(Protocol, NeverThrowsOnGarbage) {
  std::mt19937_64 random(3);
  const std::string alphabet = "{}[]\",:\\u0verbscanid \x80\xff\n";
  for (int i = 0; i < 20000; ++i) {
    std::string line(random() % 60, ' ');
    for (auto& letter : line) letter = alphabet[random() % alphabet.size()];
    expect_refused_or_whole(line);
  }
  expect_refused_or_whole(std::string(kLongestRequest, '['));
}

TEST(Protocol, SurvivesDamage) {
  const std::string sound = R"({"verb":"show","id":"20260102T030405-left"})";
  std::mt19937_64 random(4);
  for (int i = 0; i < 20000; ++i) {
    std::string line = sound;
    line[random() % line.size()] = static_cast<char>(random() % 256);
    expect_refused_or_whole(line);
  }
}

TEST(Protocol, CarriesErrorsWhole) {
  for (const auto remedy : {Remedy::kRetry, Remedy::kReopen, Remedy::kReset, Remedy::kOperator}) {
    const Error error{ErrorCode::kNoSpace, remedy, "full", "make room"};
    const auto outcome = answer_outcome(nlohmann::json::parse(error_answer(error)));
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.error().code, error.code);
    EXPECT_EQ(outcome.error().remedy, error.remedy);
    EXPECT_EQ(outcome.error().message, error.message);
    EXPECT_EQ(outcome.error().advice, error.advice);
  }
  EXPECT_TRUE(answer_outcome(nlohmann::json::parse(ok_answer({}))));
  EXPECT_FALSE(answer_outcome(nlohmann::json::parse("[]")));
}

TEST(Protocol, TakesTheUsualRemedyWhereTheAnswerNamesNone) {
  const auto outcome =
      answer_outcome(nlohmann::json::parse(R"({"ok":false,"error":{"code":"busy","remedy":3}})"));
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::kBusy);
  EXPECT_EQ(outcome.error().remedy, usual_remedy(ErrorCode::kBusy));
}

TEST(Protocol, TellsHowMuchIsDoneToAThousandth) {
  StationStatus status;
  status.done = 0.3 + 0.6;
  EXPECT_NE(to_json(status).dump().find("\"done\":0.9,"), std::string::npos);
}

TEST(Protocol, TellsUnitsAndWarningsInTheStatus) {
  StationStatus status;
  status.cameras = {{"left", "Model 1", "0042"}};
  status.warnings = {"left is another"};
  const auto json = to_json(status);
  EXPECT_EQ(json.at("cameras").at(0).at("serial"), "0042");
  EXPECT_EQ(json.at("warnings").at(0), "left is another");
}

TEST(Protocol, TellsHowEachPartIsInTheStatus) {
  StationStatus status;
  EXPECT_TRUE(to_json(status).at("pedal").is_null());
  EXPECT_EQ(to_json(status).at("trouble"), "");
  const Error stuck{ErrorCode::kBusy, Remedy::kOperator, "it is stuck", "take the foot off it"};
  status.troubles = {{{ErrorCode::kDeviceGone, Remedy::kReopen, "the camera left", ""}, "left"},
                     {stuck}};
  status.pedal = {stuck};
  status.store.root = "/scans";
  const auto json = to_json(status);
  EXPECT_EQ(json.at("trouble"), "the camera left");
  EXPECT_EQ(json.at("troubles"),
            (nlohmann::json{"the camera left", "it is stuck: take the foot off it"}));
  EXPECT_EQ(json.at("pedal").at("ok"), false);
  EXPECT_EQ(json.at("pedal").at("trouble"), "it is stuck: take the foot off it");
  EXPECT_EQ(json.at("pedal").at("advice"), "take the foot off it");
  EXPECT_EQ(json.at("store"),
            (nlohmann::json{{"root", "/scans"}, {"ok", true}, {"trouble", ""}, {"advice", ""}}));
}

TEST(Protocol, SurvivesTextThatIsNoUnicode) {
  const Error error{ErrorCode::kIo, Remedy::kOperator,
                    "a\xff"
                    "b",
                    ""};
  EXPECT_NE(error_answer(error).find("\"ok\":false"), std::string::npos);
}

}  // namespace
}  // namespace instep
