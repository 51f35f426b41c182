#include "daemon/repeat/repeat_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/repeat/repeat_report.h"
#include "daemon/repeat/repeat_svg.h"

namespace instep {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

json measure(const char* id, double value_mm) {
  return {{"id", id}, {"value_mm", value_mm}, {"u95_mm", 0.4}, {"definition", "by rule"}};
}

json only_length(double value_mm) {
  return json::array({measure("foot_length", value_mm)});
}

/// Scan number `number` of a foot whose measures are as given.
StudiedResult scan(int number, const json& measures, const char* side = "right") {
  return {fmt::format("{}.json", number),
          {{"id", fmt::format("scan-{}", number)},
           {"side", side},
           {"station", "shop"},
           {"software", {{"name", "instep"}, {"version", "1"}}},
           {"measures", measures}}};
}

std::vector<StudiedResult> seven_scans() {
  std::vector<StudiedResult> scans;
  for (int i = 0; i < 7; ++i) {
    scans.push_back(
        scan(i, {measure("foot_length", 250.0 + i), measure("ball_girth", 240.0 + 0.1 * i)}));
  }
  return scans;
}

TEST(RepeatStudy, TakesEachMeasureOverAllScans) {
  const auto study = study_repeats(seven_scans());
  ASSERT_TRUE(study) << study.error().line();
  EXPECT_THAT(study->warnings, IsEmpty());
  ASSERT_EQ(study->feet.size(), 1U);
  EXPECT_EQ(study->feet[0].side, "right");
  ASSERT_EQ(study->feet[0].measures.size(), 2U);
  const auto& length = study->feet[0].measures[0];
  EXPECT_EQ(length.id, "foot_length");
  EXPECT_DOUBLE_EQ(length.figures.mean, 253.0);
  EXPECT_DOUBLE_EQ(length.figures.range(), 6.0);
  // 0 to 6: six differences of 1, five of 2, ... one of 6: 56 in 21 pairs.
  EXPECT_NEAR(length.figures.mean_absolute_difference, 56.0 / 21.0, 1e-12);
  EXPECT_DOUBLE_EQ(length.claimed_u95.value(), 0.4);
}

TEST(RepeatStudy, TakesEachSideByItselfAndSaysSo) {
  auto scans = seven_scans();
  for (int i = 10; i < 17; ++i) scans.push_back(scan(i, only_length(250.0 + i), "left"));
  const auto study = study_repeats(scans);
  ASSERT_TRUE(study);
  ASSERT_EQ(study->feet.size(), 2U);
  EXPECT_EQ(study->feet[0].side, "left");
  EXPECT_DOUBLE_EQ(study->feet[0].measures[0].figures.mean, 263.0);
  EXPECT_THAT(study->warnings, ElementsAre(HasSubstr("both sides")));
}

TEST(RepeatStudy, LeavesOutASingleScanOfTheOtherSide) {
  auto scans = seven_scans();
  scans.push_back(scan(8, only_length(290.0), "left"));
  const auto study = study_repeats(scans);
  ASSERT_TRUE(study);
  ASSERT_EQ(study->feet.size(), 1U);
  EXPECT_EQ(study->feet[0].scans.size(), 7U);
  EXPECT_THAT(study->warnings, ElementsAre(HasSubstr("one result of the left side alone")));
}

TEST(RepeatStudy, SaysWhichMeasuresAreMissing) {
  auto scans = seven_scans();
  scans[2].result["measures"].erase(1);
  scans[2].result["withheld"] = {{{"id", "ball_girth"}, {"reason", "open"}}};
  scans[4].result["measures"][1]["value_mm"] = nullptr;
  scans[5].result["measures"][1]["value_mm"] = 1e308;
  scans[0].result["withheld"] = {{{"id", "waist_girth"}, {"reason", "open"}}};
  const auto study = study_repeats(scans);
  ASSERT_TRUE(study);
  EXPECT_EQ(study->feet[0].measures.size(), 2U);
  EXPECT_EQ(study->feet[0].measures[1].figures.values.size(), 4U);
  EXPECT_THAT(study->warnings,
              ElementsAre(HasSubstr("ball_girth of the right side is missing in 3"),
                          HasSubstr("waist_girth of the right side is missing in 7")));
}

TEST(RepeatStudy, CountsAScanOnce) {
  auto scans = seven_scans();
  scans.push_back(scans.front());
  scans.back().name = "copy.json";
  const auto study = study_repeats(scans);
  ASSERT_TRUE(study);
  EXPECT_EQ(study->feet[0].scans.size(), 7U);
  EXPECT_THAT(study->warnings, ElementsAre(HasSubstr("copy.json is the same scan")));
}

/// One recording, replayed twice, is two results that agree too well.
TEST(RepeatStudy, WarnsOfTwoScansWithTheVerySameMeasures) {
  auto scans = seven_scans();
  scans[4].result["measures"] = scans[2].result["measures"];
  const auto study = study_repeats(scans);
  ASSERT_TRUE(study);
  EXPECT_EQ(study->feet[0].scans.size(), 7U);
  EXPECT_THAT(study->warnings,
              ElementsAre(HasSubstr("4.json has the very same measures as 2.json")));
}

TEST(RepeatStudy, WarnsOfFewScansAndOfMixedOnes) {
  auto scans = seven_scans();
  scans.resize(3);
  scans[0].result["station"] = "another shop";
  scans[1].result["software"]["version"] = "2";
  scans[2].result["measures"][1].erase("u95_mm");
  const auto study = study_repeats(scans);
  ASSERT_TRUE(study);
  EXPECT_THAT(study->warnings, Contains(HasSubstr("3 scans of the right side are few")));
  EXPECT_THAT(study->warnings, Contains(HasSubstr("different stations")));
  EXPECT_THAT(study->warnings, Contains(HasSubstr("different versions")));
  EXPECT_FALSE(study->feet[0].measures[1].claimed_u95);
}

TEST(RepeatStudy, PoolsNoMeasureThatFollowsDifferentDefinitions) {
  auto scans = seven_scans();
  scans[2].result["measures"][0]["definition"] = "by another rule";
  const auto study = study_repeats(scans);
  ASSERT_TRUE(study);
  EXPECT_THAT(study->warnings,
              ElementsAre("foot_length follows different definitions: it is left out"));
  ASSERT_EQ(study->feet[0].measures.size(), 1U);
  EXPECT_EQ(study->feet[0].measures[0].id, "ball_girth");
}

/// A ball's length says "parallel to the axis", whichever that is.
TEST(RepeatStudy, PoolsNoScansOfDifferentAxes) {
  auto scans = seven_scans();
  for (auto& scan : scans) scan.result["axis"] = "pt_toe2";
  scans[1].result.erase("axis");
  EXPECT_TRUE(study_repeats(scans));
  scans[4].result["axis"] = "brannock";
  const auto study = study_repeats(scans);
  ASSERT_FALSE(study);
  EXPECT_EQ(study.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(study.error().message, HasSubstr("brannock, pt_toe2"));
}

TEST(RepeatStudy, KeepsAnglesApart) {
  auto scans = seven_scans();
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scans[i].result["measures"].push_back(
        {{"id", "toe1_angle"}, {"value_deg", 9.0 + static_cast<double>(i)}});
  }
  const auto study = study_repeats(scans);
  ASSERT_TRUE(study);
  EXPECT_TRUE(study->feet[0].measures[2].is_angle);
  const Json told = repeat_json(*study)["feet"][0]["measures"][2];
  EXPECT_EQ(told["mean_deg"], 12.0);
  EXPECT_FALSE(told.contains("mean_mm"));
  EXPECT_THAT(repeat_svg(*study), HasSubstr("deviation from the mean, degrees"));
}

TEST(RepeatStudy, RefusesWhatIsNoStudy) {
  EXPECT_FALSE(study_repeats({}));
  EXPECT_TRUE(study_repeats({scan(1, only_length(250.0)), scan(2, only_length(250.0))}));
  EXPECT_FALSE(study_repeats({scan(1, only_length(250.0))}));
  EXPECT_FALSE(
      study_repeats({scan(1, only_length(250.0), "left"), scan(2, only_length(250.0), "right")}));
  const auto copy = scan(1, only_length(250.0));
  EXPECT_FALSE(study_repeats({copy, copy}));
  for (const json& odd : {json(), json(3), json::array(), json::object(),
                          json{{"measures", {1, nullptr, {{"id", 5}}}}, {"software", 3}}}) {
    EXPECT_NO_THROW(static_cast<void>(study_repeats({{"a", odd}, {"b", odd}, {"c", odd}})));
  }
}

TEST(RepeatReport, TellsTheFigures) {
  auto scans = seven_scans();
  const auto study = study_repeats(scans);
  ASSERT_TRUE(study);
  const Json told = repeat_json(*study);
  EXPECT_EQ(told["feet"][0]["n"], 7);
  const Json& length = told["feet"][0]["measures"][0];
  EXPECT_EQ(length["sd_mm"], 2.16);  // the square root of 28 / 6
  EXPECT_EQ(length["mean_absolute_difference_mm"], 2.667);
  EXPECT_EQ(length["values_mm"].size(), 7U);
  const std::string text = repeat_text(*study);
  EXPECT_THAT(text, HasSubstr("7 scans, right foot\n"));
  EXPECT_THAT(text,
              HasSubstr("foot_length                  7   253.00 mm    2.16    6.00      2.67  "
                        "+-0.40  over the 2 mm of ISO 20685-1\n"));
  EXPECT_THAT(text, Not(HasSubstr("240.30 mm    0.22    0.60      0.27  +-0.40  over")));
}

/// The x of the dots of one row, in the order of the scans.
std::vector<double> dots_of_row(const std::string& svg, std::size_t row) {
  std::size_t at = 0;
  for (std::size_t i = 0; i <= row; ++i) at = svg.find("<path class=\"scan\"", at + 1);
  const std::size_t end = svg.find("/>", at);
  std::vector<double> places;
  for (at = svg.find('M', at); at < end; at = svg.find('M', at + 1)) {
    places.push_back(std::stod(svg.substr(at + 1)));
  }
  return places;
}

TEST(RepeatPlot, DrawsEachScanAtItsDeviation) {
  const auto study = study_repeats(seven_scans());
  ASSERT_TRUE(study);
  const std::string svg = repeat_svg(*study);
  const auto length = dots_of_row(svg, 0);
  const auto girth = dots_of_row(svg, 1);
  ASSERT_EQ(length.size(), 7U);
  ASSERT_EQ(girth.size(), 7U);
  // One scale for both: 6 mm of length are ten times 0.6 mm of girth, about the same middle.
  EXPECT_NEAR(length[6] - length[0], 10.0 * (girth[6] - girth[0]), 1.5);
  EXPECT_NEAR(length[3], girth[3], 0.1);
  EXPECT_NEAR(length[3] - length[0], length[6] - length[3], 0.2);
  EXPECT_EQ(svg, repeat_svg(*study));
}

}  // namespace
}  // namespace instep
