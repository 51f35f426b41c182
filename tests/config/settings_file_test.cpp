#include "config/settings_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <string>

#include "config/reading/settings_text.h"
#include "config/settings_description.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kCamera = "[[camera]]\nkind = \"simulated\"\n";

SettingsReading read(const std::string& toml) {
  return read_settings(toml, "/etc/s.toml");
}

TEST(SettingsFile, HasTheDocumentedDefaultsWhenOnlyACameraIsNamed) {
  const auto reading = read(kCamera);
  ASSERT_TRUE(reading.good());
  EXPECT_EQ(reading.settings.capture.frames_per_camera, 15);
  EXPECT_EQ(reading.settings.pedal.debounce, std::chrono::milliseconds(30));
  EXPECT_EQ(reading.settings.pedal.hold_to_cancel, std::chrono::milliseconds(2000));
  EXPECT_EQ(reading.settings.store.root, "/var/lib/instep/scans");
  EXPECT_EQ(reading.settings.control.socket, "/run/instep/control.sock");
  EXPECT_EQ(reading.settings.cameras.size(), 1U);
}

TEST(SettingsFile, ShippedFileIsSoundAndSaysTheDefaults) {
  const auto shipped = load_settings(test::source_tree() / "config/instep.toml");
  ASSERT_TRUE(shipped) << shipped.error().line();
  EXPECT_EQ(describe(*shipped), describe(read(kCamera).settings));
}

/// A name of 63 letters was refused as one of more than 64: they were counted in bytes.
TEST(SettingsFile, CountsTheLettersOfNames) {
  const std::string name = "Orthopädie-Schuhtechnik Müller & Söhne, Filiale Zürich-Oerlikon";
  const auto reading = read(kCamera + ("[station]\nname = \"" + name + "\""));
  ASSERT_TRUE(reading.good());
  EXPECT_EQ(reading.settings.station.name, name);
}

TEST(SettingsFile, SaysWhereThePedalIs) {
  const auto described = [](const std::string& toml) {
    return describe(read(kCamera + toml).settings);
  };
  EXPECT_THAT(described("[pedal]\nkind = \"gpio\"\n[pedal.gpio]\nline = \"foot\"\n"),
              HasSubstr("pedal    GPIO line \"foot\", active low, pulled up\n"));
  EXPECT_THAT(
      described("[pedal]\nkind = \"gpio\"\n[pedal.gpio]\nchip = \"board\"\noffset = 17\n"
                "active = \"high\"\nbias = \"none\"\n"),
      HasSubstr("pedal    GPIO line 17 of the chip \"board\", active high, without bias\n"));
  EXPECT_THAT(described("[pedal]\nkind = \"evdev\"\n[pedal.evdev]\ndevice = \"0c45:7403\"\n"
                        "key = \"KEY_B\"\n"),
              HasSubstr("pedal    KEY_B of the input device 0c45:7403\n"));
}

TEST(SettingsFile, SaysWhereLampsAndTheProjectorAre) {
  const auto reading = read(std::string(kCamera) +
                            "[lamp.busy]\nchip = \"board\"\noffset = 4\n"
                            "[projector]\nline = \"light\"\nactive = \"low\"\n"
                            "[pedal.gpio]\nline = \"light\"\n");  // which is not the pedal
  ASSERT_TRUE(reading.good()) << reading.faults.front();
  EXPECT_THAT(describe(reading.settings),
              HasSubstr("output   lamp.busy: GPIO line 4 of the chip \"board\", active high\n"
                        "output   projector: GPIO line \"light\", active low\n"));
  EXPECT_FALSE(reading.settings.outputs.ready_lamp);
}

struct Fault {
  const char* toml;
  const char* text;
};

class SettingsFault : public testing::TestWithParam<Fault> {};

TEST_P(SettingsFault, IsReportedWithItsLine) {
  const auto reading = read(std::string(kCamera) + GetParam().toml);
  EXPECT_THAT(reading.faults, ElementsAre(HasSubstr(GetParam().text)));
}

INSTANTIATE_TEST_SUITE_P(
    All, SettingsFault,
    testing::Values(
        Fault{"[pedal]\ndebounce_ms = 4",
              "/etc/s.toml:4: pedal.debounce_ms = 4 is outside 5 to 200"},
        Fault{"[pedal]\ndebounce_ms = 201", "is outside 5 to 200"},
        Fault{"[pedal]\ndebounce_ms = \"30\"", "must be a whole number, but it is text"},
        Fault{"[pedal]\ndebounce_ms = 30.5", "must be a whole number, but it is a number"},
        Fault{"[pedal]\nkind = \"simulted\"", "did you mean \"simulated\"?"},
        Fault{"[pedal]\nkind = 3", "pedal.kind must be text in quotes, but it is a whole number"},
        Fault{"[pedal]\nkind = \"gpio\"", ":3: pedal.gpio.line is missing"},
        Fault{"[pedal]\nkind = \"gpio\"\n[pedal.gpio]\nchip = \"board\"", "line is missing"},
        Fault{"[pedal]\nkind = \"gpio\"\n[pedal.gpio]\nline = \"foot\"\noffset = 3",
              "a line and an offset"},
        Fault{"[pedal.gpio]\nlines = \"foot\"", "did you mean pedal.gpio.line?"},
        Fault{"[pedal.gpio]\noffset = -1", ":4: pedal.gpio.offset = -1 is outside 0 to 1023"},
        Fault{"[pedal.gpio]\nbias = \"pull-pu\"", "did you mean \"pull-up\"?"},
        Fault{"[pedal]\nkind = \"evdev\"\n[pedal.evdev]\nkey = \"KEY_B\"",
              "pedal.evdev.device is missing"},
        Fault{"[pedal]\nkind = \"evdev\"\n[pedal.evdev]\ndevice = \"0c45:7403\"",
              "pedal.evdev.key is missing"},
        Fault{"[pedal]\nkind = \"evdev\"\n[pedal.evdev]\ndevice = \"0c45:7403\"\nkey = 12",
              ":7: pedal.evdev.key must be text in quotes, but it is a whole number"},
        Fault{"[pedal]\nkind = \"gpio\"\n[pedal.gpio]\nline = 12",
              ":6: pedal.gpio.line must be text in quotes, but it is a whole number"},
        Fault{"[pedal]\nkind = \"gpio\"\n[pedal.gpio]\nchip = \"board\"\noffset = 1024",
              ":7: pedal.gpio.offset = 1024 is outside 0 to 1023"},
        Fault{"[pedal]\nkind = \"evdev\"", ":3: pedal.evdev.device is missing"},
        Fault{"[lamp.ready]\nactive = \"high\"", ":3: lamp.ready.line is missing"},
        Fault{"[lamp.ready]\nline = \"a\"\nbias = \"none\"",
              ":5: there is no setting lamp.ready.bias"},
        Fault{"[lamp.raedy]\nline = \"a\"", "did you mean lamp.ready?"},
        Fault{"[projector]\nline = \"a\"\nactive = \"hihg\"", ":5: projector.active = \"hihg\""},
        Fault{"[lamp]\nready = \"a\"", "lamp.ready must be written as [lamp.ready]"},
        Fault{"[lamp.busy]\nline = \"a\"\n[projector]\nline = \"a\"\nchip = \"board\"",
              ":5: projector names the same line as lamp.busy"},
        Fault{"[pedal]\nkind = \"gpio\"\n[pedal.gpio]\nchip = \"board\"\noffset = 3\n"
              "[lamp.fault]\nchip = \"board\"\noffset = 3",
              ":8: lamp.fault names the same line as pedal.gpio"},
        Fault{"[pedal]\ngpio = 3", "pedal.gpio must be written as [pedal.gpio]"},
        Fault{"[pedal]\ndebounce = 30", "there is no setting pedal.debounce: did you mean"},
        Fault{"[pedl]\n", "there is no setting pedl: did you mean pedal?"},
        Fault{"[zzzzzz]\n", "there is no setting zzzzzz: known here are"},
        Fault{"[station]\nname = \"\"", "station.name must have 1 to 64 printable characters"},
        Fault{"[station]\nname = \"a\\nb\"", "printable"},
        Fault{"[station]\nname = \"a\\u202Eb\"", "printable"},
        Fault{"[station]\nname = \"of sixty-five letters, which are one too many for the name of "
              "one\"",
              "1 to 64 printable"},
        Fault{"[station]\npoint_spacing_mm = nan", "is outside 0.2 to 10"},
        Fault{"[station]\npoint_spacing_mm = inf", "is outside 0.2 to 10"},
        Fault{"[station]\nplatform_height_mm = 1e30", "is outside -1000 to 1000"},
        Fault{"[station]\nrefine_views = 1", "must be true or false"},
        Fault{"[station]\nside = \"middle\"", "is not one of \"left\", \"right\", \"auto\""},
        Fault{"[capture]\nframes_per_camera = 0", "is outside 1 to 120"},
        Fault{"[capture]\nframes_per_camera = 9223372036854775807", "is outside 1 to 120"},
        Fault{"[capture]\ndeadline_ms = 10", "is outside 200 to 60000"},
        Fault{"[capture]\nframe_limit_ms = 5001", "is outside 50 to 5000"},
        Fault{"[simulation]\nseed = -1", "simulation.seed = -1 is below 0"},
        Fault{"[simulation]\nnoise = []", "must be text in quotes, but it is a list"},
        Fault{"[[camera]]\nkind = \"recording\"", "camera.path is missing"},
        Fault{"[store]\nkeep_days = 2020-01-01", "but it is a date or time"},
        Fault{"[measures]\naxis = \"pt_toe3\"", "did you mean \"pt_toe2\"?"},
        Fault{"[measures]\naxis = 2", "measures.axis must be text in quotes"},
        Fault{"[measures]\nball_girth = \"tilted\"", "is not one of \"upright\", \"shortest\""},
        Fault{"[measures]\ninstep_girth = \"up\"", "/etc/s.toml:4: measures.instep_girth"},
        Fault{"[measures]\nheel_breadth = 40", "measures.heel_breadth must be text in quotes"},
        Fault{"[measures]\naxes = \"pca\"", "did you mean measures.axis?"},
        Fault{"[sizes]\nallowance_mm = 41", "sizes.allowance_mm = 41 is outside 0 to 40"},
        Fault{"[sizes]\nallowance = 15", "did you mean sizes.allowance_mm?"},
        Fault{"[[sizes.shop]]\nname = \"W\"", "sizes.shop.sizes must have 1 to 64 rows"},
        Fault{"[[sizes.shop]]\nsizes = [{ size = \"42\", longest_foot_mm = 268 }]",
              "sizes.shop.name is missing"},
        Fault{"[[sizes.shop]]\nname = \"W\"\nsizes = [{ longest_foot_mm = 268 }]",
              "size is missing"},
        Fault{"[[sizes.shop]]\nname = \"W\"\nsizes = [{ size = \"42\" }]",
              "longest_foot_mm is missing"},
        Fault{"[[sizes.shop]]\nname = \"W\"\nsizes = [\n{ size = \"42\", longest_foot_mm = 268 },\n"
              "{ size = \"41\", longest_foot_mm = 262 }]",
              "/etc/s.toml:7: sizes.shop.sizes must stand in the order"},
        Fault{"[[log]]\nlevel = \"info\"", "log must be written as [log]"},
        Fault{"[pedal]\nkind = \"none", "/etc/s.toml:4:"},
        Fault{"[pedal]\n[pedal]\n", "/etc/s.toml:4:"}));

TEST(Settings, SayWhichDefinitionsToMeasureBy) {
  EXPECT_EQ(read(kCamera).settings.measures, MeasuringRules{});
  const auto reading = read(std::string(kCamera) +
                            "[measures]\naxis = \"brannock\"\nball_girth = \"shortest\"\n"
                            "instep_girth = \"upright\"\nheel_breadth = \"widest\"");
  ASSERT_TRUE(reading.good());
  EXPECT_EQ(reading.settings.measures,
            (MeasuringRules{AxisRule::kMedialTangent, BallGirthRule::kShortest,
                            InstepGirthRule::kUpright, HeelBreadthRule::kWidestFifth}));
  EXPECT_THAT(describe(reading.settings),
              HasSubstr("axis brannock, ball girth shortest, instep girth upright"));
}

/// The example in the shipped file, without the marks that make it a comment.
std::string shop_example() {
  std::ifstream stream(test::source_tree() / "config/instep.toml");
  std::string example;
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (line == "#   [[sizes.shop]]") inside = true;
    if (inside && !line.starts_with("#")) break;
    if (inside) example += line.substr(1) + "\n";
  }
  return example;
}

TEST(SettingsFile, ReadsTheShopTableThatTheShippedFileTeaches) {
  const auto reading = read(kCamera + shop_example());
  ASSERT_TRUE(reading.good()) << reading.faults.front();
  const auto& tables = reading.settings.sizes.shop_tables;
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables[0].name, "Walker");
  ASSERT_EQ(tables[0].sizes.size(), 3U);
  EXPECT_EQ(tables[0].sizes[2].size, "42 wide");
  EXPECT_EQ(tables[0].sizes[2].longest_foot_mm, 268.0);
  EXPECT_EQ(tables[0].sizes[2].largest_ball_girth_mm, 264.0);
  EXPECT_FALSE(tables[0].sizes[0].largest_ball_girth_mm);
  EXPECT_THAT(describe(reading.settings), HasSubstr("Walker with 3 sizes"));
}

TEST(SettingsFile, TakesNoMoreShopSizesThanItSays) {
  const auto table = [](std::size_t rows) {
    std::string text = "[[sizes.shop]]\nname = \"W\"\nsizes = [";
    for (std::size_t i = 0; i < rows; ++i) text += "{ size = \"42\", longest_foot_mm = 268 },";
    return text + "]\n";
  };
  EXPECT_TRUE(read(kCamera + table(kMostShopSizes)).good());
  EXPECT_THAT(read(kCamera + table(kMostShopSizes + 1)).faults,
              ElementsAre(HasSubstr("1 to 64 rows")));
  std::string many = kCamera;
  for (std::size_t i = 0; i < kMostShopTables; ++i) many += table(1);
  EXPECT_TRUE(read(many).good());
  EXPECT_THAT(read(many + table(1)).faults, ElementsAre(HasSubstr("more than 32")));
}

TEST(SettingsFile, TellsWhatStandsBesideNumbersThatNoComputerHolds) {
  const auto reading = read(
      "[capture]\nframes_per_camera = 99999999999999999999\n[station]\n"
      "platform_height_mm = -1e400\npoint_spacing_mm = 1_0.5\nrefine_views = 1\n[pedal]\n"
      "debounce_ms = 1\nhold_to_cancel_ms = 9_223_372_036_854_775_808 # and text\n" +
      std::string(kCamera) + "station_from_camera = [ 1e+999, 1, 18446744073709551616 ]\n");
  EXPECT_THAT(reading.faults,
              ElementsAre(HasSubstr(":2: no number can be as large, or as small, as 9999999999"),
                          HasSubstr(":4: no number can be as large, or as small, as -1e400"),
                          HasSubstr(":5: station.point_spacing_mm = 10.5 is outside"),
                          HasSubstr(":6: station.refine_views must be true or false"),
                          HasSubstr(":8: pedal.debounce_ms = 1 is outside"),
                          HasSubstr(":9: no number can be as large, or as small, as 9_223"),
                          HasSubstr(":12: no number can be as large, or as small, as 1e+999"),
                          HasSubstr(":12: no number can be as large, or as small, as 1844674407")));
}

TEST(SettingsFile, MistakesNoFaultyPedalForALampOnItsLine) {
  EXPECT_THAT(read("[pedal]\nkind = \"gpio\"\n[pedal.gpio]\nline = \"a\"\nchip = 3\n"
                   "[lamp.ready]\nline = \"a\"\nchip = \"other\"\n" +
                   std::string(kCamera))
                  .faults,
              ElementsAre(HasSubstr(":5: pedal.gpio.chip must be text")));
}

TEST(SettingsFile, TellsTheLimitsOfANumberAsItIsWritten) {
  const std::string whole = ": whole numbers go from -9223372036854775808 to 9223372036854775807";
  const std::string fraction =
      ": numbers go from -1.7976931348623157e308 to 1.7976931348623157e308";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"-9223372036854775809", whole},   {"+99999999999999999999", whole},
      {"0xFFFFFFFFFFFFFFFF", whole},     {"0o7777777777777777777777", whole},
      {"0b" + std::string(64, '1'), ""}, {"-1e400", fraction},
      {"1_0.5e9_99", fraction},          {std::string(500, '9'), ""}};
  for (const auto& [number, limits] : cases) {
    for (const std::string end : {"", "\n", "\r\n", " # 0xFFFFFFFFFFFFFFFFFFFF\n"}) {
      EXPECT_THAT(read("[capture]\nframes_per_camera = " + number + end).faults,
                  testing::Contains(HasSubstr(":2: no number can be as large, or as small, as " +
                                              number.substr(0, 60) + limits)))
          << number << end;
    }
  }
  for (const char* number : {"9223372036854775807", "-9223372036854775808"}) {
    EXPECT_THAT(read(kCamera + ("[capture]\nframes_per_camera = " + std::string(number))).faults,
                ElementsAre(HasSubstr("outside 1 to 120")));
  }
}

TEST(SettingsFile, BlamesNoTextForANumberThatIsTooLarge) {
  const std::string name = "[station]\nname = \"99999999999999999999\"";
  EXPECT_TRUE(read(name + " # 1e999\n" + kCamera).good());
  EXPECT_THAT(read(name + " junk\n").faults,
              ElementsAre(AllOf(HasSubstr(":2: "), HasSubstr("saw 'j'"))));
  EXPECT_THAT(read("[station]\n99999999999999999999 = 1979-13-99 # 1e999\n").faults,
              ElementsAre(AllOf(HasSubstr(":2: "), HasSubstr("write TOML"))));
  // Both faults of a line; a text of two bytes a letter, and a byte order mark, before the number.
  EXPECT_THAT(read("\xef\xbb\xbf"
                   "name = [\"99999999999999999999 \xc3\xa4\", "
                   "88888888888888888888] junk\n")
                  .faults,
              ElementsAre(HasSubstr("as small, as 88888888888888888888: "), HasSubstr("saw 'j'")));
}

TEST(SettingsFile, SaysNoMoreThanOnceThatANumberIsTooLarge) {
  EXPECT_THAT(read("[[camera]]\nkind = \"v4l2\"\nname = \"a\"\nserial = \"1\"\n"
                   "depth_unit_mm = 1e999\nintrinsics = { width = 640, height = 480, fx = 500, "
                   "fy = 500, cx = 319.5, cy = 239.5 }\nstation_from_camera = [ 1, 0, 0, 0, 0, -1, "
                   "0, 0, 0, 0, -1, 500, 0, 0, 0, 1 ]\n")
                  .faults,
              ElementsAre(HasSubstr(":5: no number can be as large")));
}

TEST(SettingsFile, ReportsAllFaultsOfAFileInItsOrder) {
  const auto reading =
      read("[pedal]\ndebounce_ms = 1\nfoo = 2\n[store]\nkeep_days = -1\n" + std::string(kCamera));
  EXPECT_THAT(reading.faults, ElementsAre(HasSubstr(":2: pedal.debounce_ms"),
                                          HasSubstr(":3: there is no setting pedal.foo"),
                                          HasSubstr(":5: store.keep_days")));
}

TEST(SettingsFile, DemandsACamera) {
  EXPECT_THAT(read("").faults, ElementsAre(HasSubstr("there is no [[camera]]")));
  EXPECT_THAT(read("camera = 3").faults,
              testing::Contains(HasSubstr("camera must be written as [[camera]]")));
}

TEST(SettingsFile, RefusesASocketThatNoSystemCanName) {
  const auto reading =
      read(std::string(kCamera) + "[control]\nsocket = \"/" + std::string(120, 'a') + "\"");
  EXPECT_THAT(reading.faults, ElementsAre(HasSubstr("control.socket is longer than 100")));
}

TEST(SettingsFile, TakesRelativePathsFromItsOwnFolder) {
  const auto reading = read("[[camera]]\nkind = \"recording\"\npath = \"../visit\"\n");
  ASSERT_TRUE(reading.good());
  EXPECT_EQ(reading.settings.cameras[0].path, "/visit");
}

TEST(SettingsFile, FailsInOneErrorOnFilesThatCannotBeRead) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(load_settings(folder.path() / "none").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(load_settings(folder.path()).error().code, ErrorCode::kNotFound);
  const auto large = folder.path() / "large.toml";
  std::ofstream(large) << std::string(kLargestSettingsFile + 1, '#');
  EXPECT_EQ(load_settings(large).error().code, ErrorCode::kInvalidInput);
}

TEST(SettingsFile, NeverThrowsOnDamagedFiles) {
  std::ifstream stream(test::source_tree() / "config/instep.toml");
  const std::string shipped((std::istreambuf_iterator<char>(stream)), {});
  std::mt19937_64 random(5);
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = shipped;
    for (int hits = 0; hits < 5; ++hits) {
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    }
    damaged.resize(damaged.size() - random() % 2000);
    const auto reading = read(damaged);
    for (const auto& fault : reading.faults) EXPECT_THAT(fault, HasSubstr("/etc/s.toml:"));
  }
}

}  // namespace
}  // namespace instep
