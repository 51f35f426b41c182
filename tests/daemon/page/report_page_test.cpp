#include "daemon/page/report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <regex>

#include "daemon/page/paper.h"
#include "tests/support/foot_body.h"
#include "tests/support/xml_check.h"

namespace instep {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// An elliptic section in the upright plane over x.
Measure girth_at(const std::string& id, double x, double half_width, double half_height) {
  Measure measure;
  measure.id = id;
  measure.plane = *TapePlane::through({x, 0, 0}, {x, 10, 0}, {x, 0, 10});
  Girth girth;
  for (int i = 0; i < 90; ++i) {
    const double angle = i * std::numbers::pi / 45.0;
    girth.contour.emplace_back(half_width * std::cos(angle), half_height * (1.0 + std::sin(angle)));
  }
  girth.stretched_mm = 2.0 * std::numbers::pi * std::hypot(half_width, half_height) / 1.41421356;
  girth.contact_mm = girth.stretched_mm + 1.0;
  girth.stretched_u95_mm = 0.4;
  measure.value_mm = girth.stretched_mm;
  measure.u95_mm = girth.stretched_u95_mm;
  measure.girth = girth;
  return measure;
}

ScanRecord made_up_scan(Side side = Side::kLeft) {
  ScanRecord record;
  record.id = "20261121T091502417Z-k3f9";
  record.station = "Bern & Söhne";
  record.foot.side = side;
  const auto right = test::FootBody{}.points();
  record.foot.cloud = side == Side::kRight ? right : test::mirrored(right);
  record.foot.landmarks["pternion"] = {{0, 0, 20}, 1.0, "rearmost"};
  record.foot.landmarks["acropodion"] = {{260, 0, 10}, 1.0, "foremost"};
  record.foot.landmarks["instep_point"] = {{130, 0, 70}, 0.3, "by proportion"};
  Measure length;
  length.id = "foot_length";
  length.value_mm = 260.0;
  length.u95_mm = 0.3;
  record.measures.measures = {length, girth_at("ball_girth", 180, 45, 25),
                              girth_at("waist_girth", 150, 42, 30),
                              girth_at("instep_girth", 130, 40, 35)};
  record.measures.withheld = {{"ankle_girth", "the leg is cut below the <malleoli>"}};
  record.sizes = shoe_sizes(sized_foot(record.measures));
  return record;
}

/// The numbers that stand in the places of "#" wherever the text has the pattern, one after
/// another.
std::vector<double> numbers(const std::string& text, const std::string& pattern) {
  constexpr const char* kNumber = "0123456789.-";
  std::vector<double> found;
  const std::string head = pattern.substr(0, pattern.find('#'));
  for (auto at = text.find(head); at != std::string::npos; at = text.find(head, at + 1)) {
    std::vector<double> here;
    std::size_t place = at;
    bool fits = true;
    for (std::size_t i = 0; i < pattern.size() && fits; ++i) {
      if (pattern[i] != '#') {
        fits = place < text.size() && text[place++] == pattern[i];
        continue;
      }
      const auto end = std::min(text.find_first_not_of(kNumber, place), text.size());
      fits = end > place;
      if (fits) here.push_back(std::stod(text.substr(place, end - place)));
      place = end;
    }
    if (fits) found.insert(found.end(), here.begin(), here.end());
  }
  return found;
}

TEST(ReportPage, IsA4WithARulerOfFiftyMillimetres) {
  const std::string page = report_page(made_up_scan());
  EXPECT_EQ(test::fault_in_xml(page), "");
  EXPECT_THAT(page, HasSubstr("width=\"210mm\" height=\"297mm\" viewBox=\"0 0 2100 2970\""));
  // The last long rule is that of the footer or of the length: both are looked at.
  const auto ends = numbers(page, "class=\"rule\" x1=\"#\" y1=\"2860.0\" x2=\"#\"");
  ASSERT_GE(ends.size(), 2U);
  EXPECT_DOUBLE_EQ(ends[1] - ends[0], 500.0);
}

TEST(ReportPage, SaysWhatWasMeasuredAndWhatNot) {
  const std::string page = report_page(made_up_scan());
  for (const char* word : {"Left foot", "scan 20261121T091502417Z-k3f9", "Bern &amp; Söhne",
                           "foot length 260.0 ± 0.3", "ball girth", "along the skin",
                           "ankle girth not measured: the leg is cut below the "
                           "&lt;malleoli&gt;",
                           "Mondopoint", "instep point (by proportion)", "acropodion"}) {
    EXPECT_THAT(page, HasSubstr(word));
  }
  EXPECT_THAT(report_page(made_up_scan(Side::kRight), "foot.ply"), HasSubstr("Right foot"));
  EXPECT_THAT(report_page(made_up_scan(Side::kRight), "foot.ply"), HasSubstr("foot.ply · scan"));
  EXPECT_EQ(page, report_page(made_up_scan()));
}

TEST(ReportPage, DrawsTheFootToTheScaleItSays) {
  for (const double length : {200.0, 260.0, 310.0}) {
    auto record = made_up_scan();
    record.foot.cloud = test::mirrored(test::FootBody{length}.points());
    record.foot.landmarks["acropodion"].position_mm.x() = length;
    const std::string page = report_page(record);
    const auto scales = numbers(page, "from above, 1 : #<");
    ASSERT_EQ(scales.size(), 1U);
    const auto lines = numbers(page, "class=\"rule\" x1=\"#\" y1=\"#\" x2=\"#\"");
    const bool drawn = [&] {
      for (std::size_t i = 0; i + 2 < lines.size(); i += 3) {
        if (std::abs(lines[i + 2] - lines[i] - 10.0 * length / scales[0]) < 0.2) return true;
      }
      return false;
    }();
    EXPECT_TRUE(drawn) << "1 : " << scales[0] << " of " << length;
  }
}

TEST(ReportPage, KeepsAllOnThePageAndTheNamesOfTapesApart) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    auto record = made_up_scan(side);
    record.measures.measures.push_back(girth_at("short_heel_girth", 100, 35, 50));
    record.measures.measures.push_back(girth_at("long_heel_girth", 101, 36, 55));
    record.measures.measures.push_back(girth_at("ankle_girth", 60, 30, 45));
    const std::string page = report_page(record);
    const auto places = numbers(page, " x=\"#\" y=\"#\"");
    ASSERT_GT(places.size(), 60U);
    for (std::size_t i = 0; i + 1 < places.size(); i += 2) {
      EXPECT_GE(places[i], 0.0);
      EXPECT_LE(places[i], paper::kWidth);
      EXPECT_GE(places[i + 1], 0.0);
      EXPECT_LE(places[i + 1], paper::kHeight);
    }
    const auto names = numbers(page, "class=\"tape-name\" x=\"#\" y=\"#\"");
    ASSERT_EQ(names.size(), 2U * 2U * 6U);
    for (std::size_t i = 0; i < names.size(); i += 2) {
      for (std::size_t j = i + 2; j < names.size(); j += 2) {
        if (names[i + 1] != names[j + 1]) continue;  // of the other view
        EXPECT_GE(std::abs(names[i] - names[j]), 170.0);
      }
    }
  }
}

TEST(ReportPage, SaysHowMuchItLeftOut) {
  auto record = made_up_scan();
  for (int i = 0; i < 60; ++i) record.warnings.push_back("doubt number " + std::to_string(i));
  const std::string page = report_page(record);
  EXPECT_THAT(page, HasSubstr("doubt number 0<"));
  EXPECT_THAT(page, Not(HasSubstr("doubt number 59<")));
  const auto left_out = numbers(page, "and # more, in result.json or printed");
  const auto said = numbers(page, "doubt number #<");
  ASSERT_EQ(left_out.size(), 1U);
  EXPECT_EQ(said.size() + static_cast<std::size_t>(left_out[0]), 60U);
  const auto heights = numbers(page, "class=\"note\" x=\"#\" y=\"#\"");
  ASSERT_GE(heights.size(), 10U);
  for (std::size_t i = 1; i < heights.size(); i += 2) EXPECT_LT(heights[i], 2860.0);
}

/// What no view shows is numbered on none: one within the foot.
TEST(ReportPage, NamesTheLandmarksThatItDraws) {
  ScanRecord record = made_up_scan();
  record.foot.landmarks["arch_point"] = {{120, 0, 20}, 1.0, "hidden"};
  const std::string page = report_page(record);
  EXPECT_THAT(page, Not(HasSubstr("arch point")));
  EXPECT_THAT(page, HasSubstr("1 acropodion"));
  EXPECT_THAT(page, HasSubstr("2 instep point"));
  EXPECT_THAT(page, HasSubstr("3 pternion"));
}

TEST(ReportPage, KeepsTheNumbersOfNearLandmarksApart) {
  ScanRecord record = made_up_scan();
  for (int i = 0; i < 6; ++i) {
    record.foot.landmarks["toe" + std::to_string(i) + "_tip"] = {
        {262.0 + i, -3.0 + i, 20}, 1.0, "together"};
  }
  const auto places = numbers(report_page(record), "class=\"mark-number\" x=\"#\" y=\"#\"");
  ASSERT_GE(places.size(), 12U);
  for (std::size_t i = 0; i < places.size(); i += 2) {
    for (std::size_t j = 0; j < i; j += 2) {
      EXPECT_TRUE(std::abs(places[i] - places[j]) > 40.0 ||
                  std::abs(places[i + 1] - places[j + 1]) > 25.0)
          << i << " and " << j;
    }
  }
}

/// A label of a page: where it stands, and its text.
struct Label {
  double x = 0.0;
  double y = 0.0;
  std::string text;
};

std::vector<Label> labels(const std::string& page, const std::string& style) {
  const std::regex label("class=\"" + style + "\" x=\"([0-9.]+)\" y=\"([0-9.]+)\">([^<]*)<");
  std::vector<Label> found;
  for (std::sregex_iterator at(page.begin(), page.end(), label), end; at != end; ++at) {
    found.push_back({std::stod((*at)[1]), std::stod((*at)[2]), (*at)[3]});
  }
  return found;
}

std::vector<ShopTable> shop_tables(std::size_t count, const std::string& name,
                                   const std::string& size) {
  return std::vector<ShopTable>(count, ShopTable{name, {{size, 265.0, {}}}});
}

ScanRecord scan_with_shop_tables(const std::vector<ShopTable>& tables) {
  auto record = made_up_scan();
  SizeRules rules;
  rules.shop_tables = tables;
  record.sizes = shoe_sizes(sized_foot(record.measures), rules);
  return record;
}

TEST(ReportPage, KeepsTheNamesOfShopTablesOffTheirSizes) {
  // Of DejaVu Serif, a wide type, at the sizes of the page; the mean of the letters used here.
  constexpr double kNameLetter = 16.0;
  constexpr double kSizeLetter = 18.0;
  for (const auto& [name, size] :
       {std::pair("Lowa Renegade GTX women narrow", "UK 7.5 / EU 41.5 wide"),
        std::pair("Hanwag Tatra II Bunion GTX Lady, extra wide toes and thick insol", "9.5"),
        std::pair("Walker", "UK 7.5 / EU 41.5 / US 9 / 26")}) {
    const std::string page = report_page(scan_with_shop_tables(shop_tables(1, name, size)));
    EXPECT_THAT(page, HasSubstr(std::string(">") + size + "<"));
    std::string names;
    for (const Label& row : labels(page, "row")) {
      names += row.text + " ";
      const double name_ends = row.x + kNameLetter * static_cast<double>(row.text.size());
      EXPECT_LT(name_ends, paper::kWidth - paper::kMargin + 1.0) << row.text;
      for (const Label& value : labels(page, "value")) {
        if (value.y != row.y) continue;
        EXPECT_LT(name_ends, value.x - kSizeLetter * static_cast<double>(value.text.size()))
            << row.text << " " << value.text;
      }
    }
    EXPECT_THAT(names, HasSubstr(name));
  }
}

TEST(ReportPage, LeavesOutTheShopTablesThatItHasNoRoomFor) {
  for (const std::size_t count : {1U, 10U, 20U, 32U}) {
    auto record = scan_with_shop_tables(shop_tables(count, "Walker", "42"));
    record.measures.measures.resize(17, record.measures.measures[0]);
    for (int i = 0; i < 20; ++i) record.warnings.push_back("doubt number " + std::to_string(i));
    const std::string page = report_page(record);
    const auto rows = labels(page, "row");
    const auto shown = static_cast<std::size_t>(std::count_if(
        rows.begin(), rows.end(), [](const auto& row) { return row.text == "Walker"; }));
    EXPECT_GE(shown, std::min<std::size_t>(count, 7));
    const auto left_out = numbers(page, "and # more, in result.json or printed");
    ASSERT_EQ(left_out.size(), shown == count ? 1U : 2U);  // the notes' own is the last
    if (shown < count) {
      EXPECT_EQ(shown + static_cast<std::size_t>(left_out[0]), count);
    }
    const auto sections = labels(page, "section-name");
    ASSERT_EQ(sections.size(), 3U);
    EXPECT_GT(sections[0].y, rows.back().y + 100.0);
    const auto notes = labels(page, "note");
    ASSERT_FALSE(notes.empty());
    EXPECT_GT(notes.back().y, sections[0].y);
    EXPECT_LT(notes.back().y, 2800.0) << "above the ruler";
  }
}

TEST(ReportPage, WrapsWhatSaysWhereItIsFrom) {
  auto record = made_up_scan();
  record.station = "Orthopaedie-Schuhtechnik Mueller und Soehne, Filiale Zuerich-Nord";
  record.simulated = true;
  record.foot.side_confidence = 0.997;
  const std::string file(240, 'x');
  const std::string page = report_page(record, file + ".ply");
  std::string said;
  for (const Label& line : labels(page, "origin")) {
    constexpr double kLetter = 15.0;  // of a wide type at the size of the line
    EXPECT_LT(line.x + kLetter * static_cast<double>(line.text.size()),
              paper::kWidth - paper::kMargin + 1.0);
    said += line.text + (line.text.back() == 'x' ? "" : " ");
  }
  for (const auto& part :
       {file + ".ply", record.station, std::string("side as the scan tells, 99 % sure")}) {
    EXPECT_THAT(said, HasSubstr(part));
  }
  const auto heights_of_rules = numbers(page, "class=\"rule\" x1=\"#\" y1=\"#\"");
  ASSERT_GE(heights_of_rules.size(), 2U);
  EXPECT_GT(heights_of_rules[1], labels(page, "origin").back().y);
  EXPECT_GT(labels(page, "caption").front().y, heights_of_rules[1] + 20.0);
}

TEST(ReportPage, SaysADoubtOfSeveralMeasuresOnce) {
  auto record = made_up_scan();
  for (std::size_t i = 1; i < 4; ++i) record.measures.measures[i].warnings = {"it is a guess"};
  EXPECT_THAT(report_page(record),
              HasSubstr("ball girth, waist girth, instep girth: it is a guess<"));
}

TEST(ReportPage, LeavesNamesInItsNotesAsTheyAre) {
  auto record = made_up_scan();
  record.warnings = {"camera cam_left_1 gave 3 frames: set platform_height_mm"};
  record.measures.measures[1].warnings = {"beside cam_left_1"};
  record.measures.withheld = {{"ankle_girth", "hidden from cam_left_1"}};
  const std::string page = report_page(record);
  for (const char* note :
       {">camera cam_left_1 gave 3 frames: set platform_height_mm<",
        ">ball girth: beside cam_left_1<", ">ankle girth not measured: hidden from cam_left_1<"}) {
    EXPECT_THAT(page, HasSubstr(note));
  }
}

TEST(ReportPage, SaysByWhichChoiceOfDefinitionsAMeasureWasTaken) {
  auto scan = made_up_scan();
  EXPECT_THAT(report_page(scan), HasSubstr(">ball girth</text>"));
  scan.foot.rules.axis = AxisRule::kHeelCentre;
  scan.foot.rules.ball_girth = BallGirthRule::kShortest;
  scan.foot.rules.instep_girth = InstepGirthRule::kUpright;
  const auto page = report_page(scan);
  for (const char* name : {"foot length", "(axis heel centre)", "ball girth (shortest)",
                           "waist girth", "instep girth (upright)"}) {
    EXPECT_THAT(page, HasSubstr(std::string(">") + name + "</text>"));
  }
}

TEST(ReportPage, KeepsTheNamesOfMeasuresOffTheirValues) {
  // Of DejaVu Serif, a wide type, at the sizes of the page.
  constexpr double kNameLetter = 14.5;
  constexpr double kValueLetter = 17.0;
  auto record = made_up_scan();
  record.foot.rules = {AxisRule::kHeelCentre, BallGirthRule::kShortest, InstepGirthRule::kUpright,
                       HeelBreadthRule::kFortyMm};
  record.pair = ScannedPair{"left", "right", pair_feet(record.measures, record.measures), {}};
  const std::string page = report_page(record);
  ASSERT_THAT(page, HasSubstr("(axis heel centre)"));
  const std::regex row(
      "class=\"row\" x=\"([0-9.]+)\" y=\"([0-9.]+)\">([^<]*)<[^<]*"
      "<text class=\"value\" x=\"([0-9.]+)\" y=\"([0-9.]+)\">([^<]*)<");
  int rows = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), row), end; at != end; ++at, ++rows) {
    EXPECT_EQ((*at)[2], (*at)[5]);
    const double name_ends =
        std::stod((*at)[1]) + kNameLetter * static_cast<double>((*at)[3].length());
    const double value_begins =
        std::stod((*at)[4]) - kValueLetter * static_cast<double>((*at)[6].length());
    EXPECT_LT(name_ends, value_begins) << (*at)[3] << " " << (*at)[6];
  }
  EXPECT_GE(rows, 4);
}

TEST(ReportPage, SaysWhatTheOtherFootHasMore) {
  auto record = made_up_scan();
  auto right = record.measures;
  right.measures[0].value_mm += 2.5;
  right.measures[1].value_mm -= 1.5;
  record.pair = ScannedPair{"left", "right", pair_feet(record.measures, right),
                            shoe_sizes(larger_of(sized_foot(record.measures), sized_foot(right)))};
  const std::string left_page = report_page(record);
  EXPECT_THAT(left_page, HasSubstr(">right</text>"));
  EXPECT_THAT(left_page, HasSubstr(">+2.5</text>"));
  EXPECT_THAT(left_page, HasSubstr(">-1.5</text>"));
  EXPECT_THAT(left_page, HasSubstr(">265"));
  record.foot.side = Side::kRight;
  EXPECT_THAT(report_page(record), HasSubstr(">-2.5</text>"));
}

TEST(ReportPage, StandsWhateverItIsGiven) {
  EXPECT_EQ(test::fault_in_xml(report_page(ScanRecord{})), "");
  auto record = made_up_scan();
  record.foot.cloud.positions.emplace_back(kNan, 1.0, 2.0);
  record.foot.landmarks["pternion"].position_mm.y() = kNan;
  record.measures.measures[1].girth->contour[0].x() = kNan;
  record.measures.measures[2].girth->contour.clear();
  record.measures.measures[3].girth->contour.assign(50, {1.0, 1.0});
  record.station = "<script>";
  EXPECT_EQ(test::fault_in_xml(report_page(record)), "");
  record.foot.cloud.positions.assign(1, {5.0, 5.0, 5.0});
  EXPECT_EQ(test::fault_in_xml(report_page(record)), "");
  record.foot.cloud.positions.assign(500, {5.0, 5.0, 500.0});
  EXPECT_EQ(test::fault_in_xml(report_page(record)), "");
}

}  // namespace
}  // namespace instep
