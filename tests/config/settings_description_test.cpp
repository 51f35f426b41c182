#include "config/settings_description.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "config/settings_file.h"

namespace instep {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string described(const std::string& toml) {
  const auto reading = read_settings(toml, "/etc/s.toml");
  for (const auto& fault : reading.faults) ADD_FAILURE() << fault;
  return describe(reading.settings);
}

constexpr const char* kSimulated = "[[camera]]\nkind = \"simulated\"\n";
constexpr const char* kGpioPedal =
    "[[camera]]\nkind = \"simulated\"\n[pedal]\nkind = \"gpio\"\ngpio.line = \"foot\"\n";
constexpr const char* kOpenni =
    "[[camera]]\nkind = \"openni2\"\nname = \"left\"\nserial = \"A1\"\n"
    "stands_at_mm = [500, 0, 60]\nlooks_at_mm = [0, 0, 60]\n";
constexpr const char* kVideo =
    "[[camera]]\nkind = \"v4l2\"\nname = \"top\"\nserial = \"819\"\ndepth_unit_mm = 1\n"
    "intrinsics = { width = 640, height = 480, fx = 383.5, fy = 384, cx = 319, cy = 239 }\n"
    "station_from_camera = [1, 0, 0, 0,  0, -1, 0, 0,  0, 0, -1, 700,  0, 0, 0, 1]\n";

/// A setting, added to a station, and what it makes --check say that it did not say before.
struct Said {
  const char* station;
  const char* setting;
  const char* text;
};

class SettingsDescription : public testing::TestWithParam<Said> {};

TEST_P(SettingsDescription, TellsOfEverySetting) {
  const auto [station, setting, text] = GetParam();
  EXPECT_THAT(described(station), Not(HasSubstr(text)));
  EXPECT_THAT(described(std::string(station) + setting), HasSubstr(text));
}

INSTANTIATE_TEST_SUITE_P(
    All, SettingsDescription,
    testing::Values(
        Said{kSimulated, "[station]\nname = \"Bern\"", "station  Bern, "},
        Said{kSimulated, "[station]\nplatform_height_mm = 12.5", "platform at 12.5 mm"},
        Said{kSimulated, "[station]\npoint_spacing_mm = 0.7", "points every 0.7 mm"},
        Said{kSimulated, "[station]\nrefine_views = false", "poses and lenses are trusted"},
        Said{kSimulated, "[station]\nside = \"left\"", "side left"},
        Said{kSimulated, "[capture]\nframes_per_camera = 21", "21 frames of each camera"},
        Said{kSimulated, "[capture]\nwarmup_frames = 9", "after 9 to warm up"},
        Said{kSimulated, "[capture]\ndeadline_ms = 4321", "within 4321 ms"},
        Said{kSimulated, "[capture]\nframe_limit_ms = 432", "each frame within 432 ms"},
        Said{kSimulated, "[capture]\none_at_a_time = true", "one camera at a time"},
        Said{kSimulated, "[capture]\ncheck_every_s = 77", "looked at every 77 s"},
        Said{kSimulated, "[pedal]\nkind = \"none\"", "pedal    none"},
        Said{kSimulated, "[pedal]\ndebounce_ms = 44", "bounces for 44 ms"},
        Said{kSimulated, "[pedal]\nhold_to_cancel_ms = 1234", "held for 1234 ms"},
        Said{kSimulated, "[pedal]\nfifo = \"/tmp/tap\"", "written to /tmp/tap"},
        Said{kGpioPedal, "debounce_ms = 44", "bounces for 44 ms"},
        Said{kGpioPedal, "gpio.chip = \"board\"", "of the chip \"board\""},
        Said{kSimulated, "[lamp.busy]\nline = \"yellow\"", "lamp.busy: GPIO line \"yellow\""},
        Said{kSimulated, "[simulation]\nseed = 42", "of seed 42"},
        Said{kSimulated, "[simulation]\nsubject = \"feet\"", "subject  both feet"},
        Said{kSimulated, "[simulation]\nsubject = \"last\"", "subject  a last"},
        Said{kSimulated, "[simulation]\nside = \"left\"", "subject  the left foot"},
        Said{kSimulated, "[simulation]\ncameras = 3", "cameras  3 simulated"},
        Said{kSimulated, "[simulation]\nwidth_px = 320", "320 x 480 px"},
        Said{kSimulated, "[simulation]\nheight_px = 240", "640 x 240 px"},
        Said{kSimulated, "[simulation]\nnoise = \"none\"", "no noise"},
        Said{kSimulated, "[simulation]\npacing = \"fast\"", "as fast as they can"},
        Said{kSimulated, "[simulation]\ntruth = false", "its truth is not told"},
        Said{kSimulated, "[simulation]\nfault_script = \"f.txt\"", "on command of /etc/f.txt"},
        Said{kSimulated, "[store]\nroot = \"/srv/scans\"", "store    /srv/scans"},
        Said{kSimulated, "[store]\nkeep_days = 31", "kept for 31 days"},
        Said{kSimulated, "[store]\nkeep_count = 900", "at most 900"},
        Said{kSimulated, "[measures]\naxis = \"pca\"", "axis pca"},
        Said{kSimulated, "[sizes]\nallowance_mm = 18", "lasts 18 mm longer"},
        Said{kSimulated,
             "[[sizes.shop]]\nname = \"W\"\nsizes = [{ size = \"41\", longest_foot_mm = 262 }, "
             "{ size = \"42\", longest_foot_mm = 268, largest_ball_girth_mm = 252 }]",
             "W with 2 sizes: 41 up to 262 mm; 42 up to 268 mm and 252 mm round the ball\n"},
        Said{kSimulated, "[control]\nsocket = \"/tmp/s\"", "control  /tmp/s"},
        Said{kSimulated, "[log]\nlevel = \"debug\"", "log      debug"},
        Said{kOpenni, "library_folder = \"/opt/maker\"", "library in /opt/maker"},
        Said{kOpenni, "roll_deg = 180", "the top of its image along (0.000, 0.000, -1.000)"},
        Said{kOpenni,
             "intrinsics = { width = 640, height = 480, fx = 575.8, fy = 576, cx = 319.5, cy = 239 "
             "}",
             "lens     left with 640 x 480 px, f 575.8, 576 px, centre 319.5, 239 px"},
        Said{kVideo, "bus_path = \"usb-0000:00:14.0-2\"", "at usb-0000:00:14.0-2"},
        Said{kVideo, "format = \"Y16\"", "Y16, depth in 1 mm"},
        Said{kVideo, "controls = [ { name = \"gain\", value = 16 } ]", "gain = 16"}));

TEST(SettingsDescription, TellsWhereACameraStandsAndLooks) {
  // By the definitions: a camera looks along its z, and its y points to the bottom of the image.
  EXPECT_THAT(
      described(kOpenni),
      HasSubstr("pose     left at (500.0, 0.0, 60.0) mm, looks along (-1.000, 0.000, 0.000),"
                " the top of its image along (0.000, 0.000, 1.000)\n"));
  EXPECT_THAT(described(kVideo),
              AllOf(HasSubstr("pose     top at (0.0, 0.0, 700.0) mm, looks along (0.000, 0.000, "
                              "-1.000), the top of its image along (0.000, 1.000, 0.000)\n"),
                    HasSubstr("lens     top with 640 x 480 px, f 383.5, 384 px")));
}

TEST(SettingsDescription, SaysNothingOfWhatPlaysNoPart) {
  const auto real = described(std::string(kOpenni) +
                              "[pedal]\nkind = \"none\"\n[simulation]\nfault_script = \"f.txt\"");
  EXPECT_THAT(real, AllOf(Not(HasSubstr("seed")), Not(HasSubstr("f.txt")),
                          Not(HasSubstr("bounces")), Not(HasSubstr("lens    "))));
}

}  // namespace
}  // namespace instep
