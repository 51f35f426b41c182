#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <regex>
#include <string>
#include <vector>

#include "daemon/report/csv_report.h"
#include "daemon/report/number_text.h"
#include "daemon/report/pair_report.h"
#include "daemon/report/result_json.h"
#include "daemon/report/section_drawing.h"
#include "daemon/report/sections_svg.h"
#include "daemon/report/sizes_report.h"
#include "daemon/report/svg_text.h"
#include "daemon/report/text_report.h"
#include "tests/support/xml_check.h"

namespace instep {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Girth square_girth() {
  Girth girth;
  girth.stretched_mm = 240.00049;
  girth.contact_mm = 241.0;
  girth.stretched_u95_mm = 0.2345678;
  girth.points = 9;
  girth.band_points = 5;
  girth.contour = {{-40, 0}, {40, 0}, {40, 40}, {0, 30}, {-40, 40}};
  girth.warnings = {"a <gap> & \"more\""};
  return girth;
}

FootScan small_foot() {
  FootScan foot;
  foot.side = Side::kLeft;
  foot.side_confidence = 0.97;
  foot.cloud.positions = {{0, 0, 0}, {170, 30, 10}, {170, -30, 20}, {250, 0, 5}};
  foot.landmarks["pternion"] = {{0, 0, 20}, 1.0, "rearmost"};
  foot.landmarks["acropodion"] = {{251.25, 3, 10}, 1.0, "foremost"};
  foot.warnings = {"of the foot"};
  return foot;
}

MeasureSet small_set() {
  MeasureSet set;
  set.measures.resize(2);
  set.measures[0].id = "foot_length";
  set.measures[0].value_mm = 251.25;
  set.measures[0].definition = "from heel to toe";
  auto& girth = set.measures[1];
  girth.id = "ball_girth";
  girth.girth = square_girth();
  girth.value_mm = girth.girth->stretched_mm;
  girth.u95_mm = girth.girth->stretched_u95_mm;
  girth.plane = *TapePlane::through({170, 0, 0}, {170, 10, 0}, {170, 0, 10});
  girth.warnings = girth.girth->warnings;
  set.withheld = {{"waist_girth", "the section is open"}};
  return set;
}

ShoeSizes small_sizes() {
  SizeRules rules;
  rules.shop_tables = {{"Walker", {{"40", 255.0, 250.0}}}, {"Pump", {{"38", 240.0, {}}}}};
  return shoe_sizes(sized_foot(small_set()), rules);
}

ScanRecord small_record() {
  ScanRecord record;
  record.id = "20261121T091502417Z-k3f9";
  record.time = std::chrono::system_clock::time_point(std::chrono::milliseconds(1795252502417));
  record.station = "shop";
  record.devices.resize(1);
  record.devices[0].geometry.id = "north";
  record.timings_ms = {{"fuse", 12.34567}};
  record.quality = {{"seen_share", kNan}};
  record.warnings = {"of the scan"};
  record.foot = small_foot();
  record.measures = small_set();
  return record;
}

TEST(Report, TenthsAreThoseOfTheThousandthsThatAreKept) {
  EXPECT_EQ(tenths(284.2504), tenths(284.25));
  EXPECT_EQ(tenths(0.6497), tenths(0.65));
  EXPECT_EQ(tenths(251.349), "251.3");
  EXPECT_EQ(interval_text(100.0, 0.6497), "100.0 ± " + tenths(0.65));
  EXPECT_EQ(interval_text(100.0, 0.00055), "100.0 ± 0.1") << "none is exact";
}

TEST(ResultJson, HoldsWhatAGirthIs) {
  const Json json = girth_json("rbf", square_girth(), {1.5, 2.25, 4.0});
  EXPECT_EQ(json["method"], "rbf");
  EXPECT_DOUBLE_EQ(json["stretched_mm"].get<double>(), 240.00049);
  EXPECT_DOUBLE_EQ(json["stretched_u95_mm"].get<double>(), 0.234568) << "to 0.000001 mm";
  EXPECT_TRUE(json["contact_u95_mm"].is_null());
  EXPECT_EQ(json["points"], 9);
  EXPECT_EQ(json["warnings"].size(), 1U);
  EXPECT_DOUBLE_EQ(json["elapsed_ms"]["total"].get<double>(), 4.0);
}

TEST(ResultJson, HoldsWhatAFootIs) {
  const Json json = foot_json(small_foot(), small_set(), small_sizes());
  EXPECT_EQ(json["side"], "left");
  EXPECT_EQ(json["axis"], "pt_toe2");
  ASSERT_EQ(json["frame"].size(), 16U);
  EXPECT_EQ(json["frame"][0], 1.0);
  EXPECT_EQ(json["landmarks"]["acropodion"]["xyz_mm"][0], 251.25);
  ASSERT_EQ(json["measures"].size(), 2U);
  EXPECT_EQ(json["measures"][0]["id"], "foot_length");
  EXPECT_TRUE(json["measures"][0]["u95_mm"].is_null());
  EXPECT_FALSE(json["measures"][0].contains("plane"));
  EXPECT_EQ(json["measures"][1]["plane"].size(), 3U);
  EXPECT_EQ(json["measures"][1]["contact_mm"], 241.0);
  EXPECT_EQ(json["withheld"][0]["id"], "waist_girth");
}

TEST(ResultJson, GivesAnglesInDegreesAndTheTwoPartsOfAnInterval) {
  MeasureSet set = small_set();
  Measure angle;
  angle.id = "toe1_angle";
  angle.value_mm = kNan;
  angle.value_deg = 9.5;
  angle.u95_deg = 0.6;
  set.measures.push_back(angle);
  set.measures[1].parts = DoubtParts{0.2, 0.1};
  const Json json = foot_json(small_foot(), set, small_sizes());
  EXPECT_EQ(json["measures"][1]["surface_u95_mm"], 0.2);
  EXPECT_EQ(json["measures"][1]["landmarks_u95_mm"], 0.1);
  EXPECT_EQ(json["measures"][2]["value_deg"], 9.5);
  EXPECT_EQ(json["measures"][2]["u95_deg"], 0.6);
  EXPECT_FALSE(json["measures"][2].contains("value_mm"));
  EXPECT_NE(foot_text(small_foot(), set, small_sizes()).find("9.5 °   ± 0.6"), std::string::npos);
}

TEST(ResultJson, HoldsTheSizes) {
  const Json sizes = foot_json(small_foot(), small_set(), small_sizes())["sizes"];
  EXPECT_EQ(sizes["mondopoint_mm"], 250.0);
  EXPECT_EQ(sizes["eu"], 40.0);
  EXPECT_EQ(sizes["exact"]["eu"], 39.94);
  EXPECT_EQ(sizes["us_women"], 8.5);
  EXPECT_EQ(sizes["jis_women"], "25.0 E");
  EXPECT_FALSE(sizes.contains("mondopoint_width_mm"));
  EXPECT_EQ(sizes["shop"][0], Json({{"table", "Walker"}, {"size", "40"}, {"note", ""}}));
  EXPECT_TRUE(sizes["shop"][1]["size"].is_null());
  EXPECT_NE(sizes["guide"].get<std::string>().find("guidance"), std::string::npos);
}

TEST(ResultJson, SaysWhenAndWhere) {
  const Json json = result_json(small_record());
  EXPECT_EQ(json["id"], "20261121T091502417Z-k3f9");
  EXPECT_EQ(json["time"], "2026-11-21T09:15:02.417Z");
  EXPECT_EQ(json["software"]["name"], "instep");
  EXPECT_EQ(json["devices"][0]["id"], "north");
  EXPECT_TRUE(json["quality"]["seen_share"].is_null());
  EXPECT_DOUBLE_EQ(json["timings_ms"]["fuse"].get<double>(), 12.346);
  EXPECT_EQ(json["warnings"], Json({"of the scan", "of the foot"}));
  EXPECT_EQ(Json::parse(json.dump()), json);
}

TEST(ResultJson, NeverHoldsWhatIsNoNumber) {
  auto set = small_set();
  set.measures[0].value_mm = kNan;
  set.measures[1].u95_mm = std::numeric_limits<double>::infinity();
  const Json json = foot_json(small_foot(), set, shoe_sizes(sized_foot(set)));
  EXPECT_TRUE(json["measures"][0]["value_mm"].is_null());
  EXPECT_TRUE(json["measures"][1]["u95_mm"].is_null());
  EXPECT_FALSE(json["sizes"].contains("mondopoint_mm"));
  EXPECT_EQ(json["sizes"]["notes"].size(), 1U);
}

ScannedPair small_pair() {
  auto right = small_set();
  right.measures[0].value_mm += 1.5;
  right.measures[1].value_mm += 0.2;
  right.withheld.clear();
  right.measures.push_back(right.measures[0]);
  right.measures.back().id = "foot_breadth";
  const auto sizes = shoe_sizes(larger_of(sized_foot(small_set()), sized_foot(right)));
  return {"left id", "right id", pair_feet(small_set(), right), sizes};
}

TEST(PairReport, HoldsBothFeetSideBySide) {
  auto record = small_record();
  EXPECT_FALSE(result_json(record).contains("pair"));
  record.pair = small_pair();
  const Json json = result_json(record)["pair"];
  EXPECT_EQ(json["left"], "left id");
  EXPECT_EQ(json["right"], "right id");
  EXPECT_EQ(json["leads"], "right");
  EXPECT_EQ(json["measures"][0], Json({{"id", "foot_length"},
                                       {"left_mm", 251.25},
                                       {"right_mm", 252.75},
                                       {"difference_mm", 1.5},
                                       {"u95_mm", nullptr},
                                       {"larger", "right"}}));
  EXPECT_EQ(json["measures"][1]["difference_mm"], 0.2);
  EXPECT_TRUE(json["measures"][1]["larger"].is_null());
  EXPECT_EQ(json["of_one_foot"], Json({"foot_breadth"}));
  EXPECT_EQ(json["sizes"]["mondopoint_mm"], 255.0);
}

TEST(PairReport, IsReadAsATable) {
  const std::string text = pair_text(nlohmann::json(pair_json(small_pair())));
  for (const char* line :
       {"  foot_length                  251.2   252.8    +1.5        right\n",
        "  ball_girth                   240.0   240.2    +0.2 +-0.3\n",
        "  foot_breadth              of one foot only\n", "  the right foot is longer and leads\n",
        "size guide: Mondopoint 255"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  }
}

TEST(PairReport, LeavesOutWhatIsOfTheWrongShape) {
  for (const char* odd : {"3", "[]", "{}", R"({"measures": [1, {"id": 2}], "sizes": 3})"}) {
    EXPECT_NO_THROW(static_cast<void>(pair_text(nlohmann::json::parse(odd)))) << odd;
  }
  EXPECT_EQ(pair_text(nlohmann::json()), "");
}

TEST(TextReport, AlignsMeasuresAndTellsIntervals) {
  const std::string text = foot_text(small_foot(), small_set(), small_sizes());
  EXPECT_NE(text.find("Left foot"), std::string::npos);
  EXPECT_NE(text.find("ball girth     240.0 mm  ± 0.2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("foot length    251.2 mm\n"), std::string::npos) << text;
  EXPECT_NE(text.find("waist girth        -     the section is open"), std::string::npos) << text;
  EXPECT_NE(text.find("! of the foot"), std::string::npos);
}

TEST(TextReport, TellsTheSizes) {
  const std::string text = foot_text(small_foot(), small_set(), small_sizes());
  EXPECT_NE(text.find("size guide: Mondopoint 250, EU 40, UK 6.5, US men 7.5, US women 8.5, "
                      "JIS men 25.0 E, JIS women 25.0 E\n"
                      "  Walker: 40\n"
                      "  Pump: none (no size of the table is long and wide enough)\n"),
            std::string::npos)
      << text;
}

TEST(SizesText, LeavesOutWhatIsOfTheWrongShape) {
  for (const char* odd : {"3", "[]", "{}", R"({"eu": "x", "shop": [1, {}], "notes": [{}]})"}) {
    EXPECT_NO_THROW(static_cast<void>(sizes_text(nlohmann::json::parse(odd)))) << odd;
  }
}

TEST(TextReport, TellsAGirth) {
  const std::string text = girth_text("rbf", square_girth());
  EXPECT_NE(text.find("stretched    240.0 ± 0.2 mm\n"), std::string::npos) << text;
  EXPECT_NE(text.find("contact      241.0 mm\n"), std::string::npos) << text;
}

TEST(CsvReport, HasALineForEachMeasure) {
  EXPECT_EQ(result_csv(foot_json(small_foot(), small_set(), small_sizes())),
            "side,id,value_mm,u95_mm,contact_mm,warnings,value_deg,u95_deg,definition,axis\n"
            "left,foot_length,251.250,,,\"\",,,\"from heel to toe\",pt_toe2\n"
            "left,ball_girth,240.000,0.235,241.000,\"a <gap> & \"\"more\"\"\",,,\"\",pt_toe2\n"
            "left,waist_girth,,,,\"the section is open\",,,,pt_toe2\n");
}

TEST(CsvReport, HasTheAnglesInAColumnOfTheirOwn) {
  const auto result = nlohmann::json::parse(
      R"({"side": "right", "axis": "brannock", "measures": [{"id": "toe1_angle", "value_deg": 9.5,
          "u95_deg": 0.6, "definition": "by \"rule\""}, 3, {"id": 4}],
          "withheld": "none"})");
  EXPECT_EQ(result_csv(result),
            "side,id,value_mm,u95_mm,contact_mm,warnings,value_deg,u95_deg,definition,axis\n"
            "right,toe1_angle,,,,\"\",9.500,0.600,\"by \"\"rule\"\"\",brannock\n");
}

TEST(SectionsSvg, IsSoundAndShowsTheNumbers) {
  const std::string svg = sections_svg(small_foot(), small_set());
  EXPECT_EQ(test::fault_in_xml(svg), "");
  EXPECT_NE(svg.find("240.0 ± 0.2 mm"), std::string::npos);
  EXPECT_NE(svg.find("251.2 mm"), std::string::npos);
  for (const char* word : {"Left foot", "medial", "lateral", "dorsal", "plantar"}) {
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(svg, sections_svg(small_foot(), small_set()));
}

TEST(SectionsSvg, DrawsTheTapeOverTheHollow) {
  const std::string svg = sections_svg(small_foot(), small_set());
  const auto corners = [&](const std::string& style) {
    const std::size_t at = svg.rfind("<polygon class=\"" + style + "\"");
    const std::string element = svg.substr(at, svg.find("/>", at) - at);
    return std::count(element.begin(), element.end(), ',');
  };
  EXPECT_EQ(corners("skin"), 5);
  EXPECT_EQ(corners("tape"), 4);
}

/// The lowest and the highest places on the page of all labels whose class and text are such.
std::pair<double, double> heights(const std::string& svg, const std::string& style,
                                  const std::string& text) {
  const std::regex label("class=\"(?:" + style + ")\" x=\"[0-9.]+\" y=\"([0-9.]+)\">" + text + "<");
  std::vector<double> found;
  for (std::sregex_iterator at(svg.begin(), svg.end(), label), end; at != end; ++at) {
    found.push_back(std::stod((*at)[1]));
  }
  if (found.empty()) return {kNan, kNan};
  const auto [least, most] = std::minmax_element(found.begin(), found.end());
  return {*least, *most};
}

/// A tape round the ankle lies level: it has a front and a heel, and is off the floor.
TEST(SectionsSvg, AreLabelledByTheirPlane) {
  auto set = small_set();
  const auto has = [&](const std::string& label) {
    return sections_svg(small_foot(), set).find(">" + label + "<") != std::string::npos;
  };
  EXPECT_TRUE(has("dorsal") && has("plantar") && !has("heel"));
  set.measures[1].plane = *TapePlane::through({0, 0, 90}, {10, 0, 90}, {0, 10, 90});
  EXPECT_TRUE(has("front") && has("heel") && !has("dorsal") && !has("plantar"));
  EXPECT_TRUE(draw_section(small_foot(), set.measures[1]).is_level);
  set.measures[1].plane = *TapePlane::through({0, 0, 10}, {60, 0, 70}, {0, 10, 10});
  EXPECT_TRUE(has("instep") && has("heel") && !has("dorsal") && !has("plantar"));
  EXPECT_FALSE(draw_section(small_foot(), set.measures[1]).is_level);
}

TEST(SectionsSvg, StandBelowATableOfAnyLength) {
  for (const auto& [measures, withheld] : {std::pair(2, 1), std::pair(18, 0), std::pair(11, 7)}) {
    auto set = small_set();
    set.measures[1].girth->contour = {{-40, 0}, {40, 0}, {40, 170}, {-40, 170}};
    set.measures.resize(static_cast<std::size_t>(measures), set.measures[0]);
    set.withheld.resize(static_cast<std::size_t>(withheld), {"waist_girth", "the section is open"});
    const std::string svg = sections_svg(small_foot(), set);
    const double table_bottom = heights(svg, "row|value|doubt", "[^<]*").second;
    const double sections_top = heights(svg, "side", "dorsal").first;
    EXPECT_GT(sections_top, table_bottom + 20.0) << measures << " and " << withheld;
    EXPECT_GT(sections_top, heights(svg, "length", "[^<]*").second + 20.0);
  }
}

TEST(SectionsSvg, StandsWhateverItIsGiven) {
  EXPECT_EQ(test::fault_in_xml(sections_svg(FootScan{}, MeasureSet{})), "");
  auto foot = small_foot();
  foot.cloud.positions.emplace_back(kNan, 1.0, 2.0);
  foot.landmarks["pternion"].position_mm.y() = kNan;
  auto set = small_set();
  set.measures[1].girth->contour[0].x() = kNan;
  set.withheld[0].id = "<script>";
  EXPECT_EQ(test::fault_in_xml(sections_svg(foot, set)), "");
  set.measures[1].girth->contour.clear();
  EXPECT_EQ(test::fault_in_xml(sections_svg(foot, set)), "");
}

TEST(SectionsSvg, DrawNoLengthWithoutBothItsEnds) {
  auto foot = small_foot();
  const std::string drawn = R"(class="length")";
  EXPECT_NE(sections_svg(foot, small_set()).find(drawn), std::string::npos);
  foot.landmarks["acropodion"].position_mm.x() = kNan;
  EXPECT_EQ(sections_svg(foot, small_set()).find(drawn), std::string::npos);
}

TEST(SvgText, EscapesWhatXmlDoesNotTake) {
  EXPECT_EQ(svg::escaped("a<b>&\"'\x01"), "a&lt;b&gt;&amp;&quot;&apos;");
  EXPECT_EQ(svg::escaped("M\xFCller \xEF\xBF\xBF"), "M\xEF\xBF\xBDller \xEF\xBF\xBD");
}

}  // namespace
}  // namespace instep
