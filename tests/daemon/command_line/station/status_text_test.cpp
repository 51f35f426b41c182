#include "daemon/command_line/station/status_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace instep {
namespace {

using nlohmann::json;

json output(const char* name, bool on, const char* trouble = "") {
  return {{"name", name}, {"on", on}, {"ok", *trouble == 0}, {"trouble", trouble}};
}

TEST(StatusText, SaysWhatRunsAndHowEachDeviceIs) {
  const json status = {
      {"state", "capturing"},
      {"stage", "capture"},
      {"done", 0.25},
      {"scans", 3},
      {"ignored_presses", 1},
      {"cameras",
       {{{"id", "front"}, {"ok", true}, {"frames", {{"good", 12U}, {"lost", 2U}, {"stale", 0U}}}},
        {{"id", "back"}, {"ok", false}, {"trouble", "it left"}, {"recovery", "resetting"}}}},
      {"outputs", {output("lamp.ready", false), output("lamp.busy", true)}}};
  EXPECT_EQ(status_text(status),
            "capturing: capture 25 %\n"
            "  camera front        ok (frames: 12 good, 2 lost)\n"
            "  camera back         it left (resetting)\n"
            "  lamp.ready          off\n"
            "  lamp.busy           on\n"
            "  scans 3, ignored presses 1\n");
}

// A camera's hid what was wrong with the pedal.
TEST(StatusText, NamesTheTroubleOfEachPart) {
  const json status = {{"state", "fault"},
                       {"trouble", "the camera left"},
                       {"cameras", {{{"id", "back"}, {"ok", false}, {"trouble", "it left"}}}},
                       {"store", {{"root", "/scans"}, {"ok", false}, {"trouble", "it is full"}}},
                       {"pedal", {{"ok", false}, {"trouble", "it is stuck"}}}};
  EXPECT_EQ(status_text(status),
            "fault: the camera left\n"
            "  camera back         it left\n"
            "  results             it is full\n"
            "  pedal               it is stuck\n"
            "  scans 0, ignored presses 0\n");
}

TEST(StatusText, WarnsOfWhatStopsNoScan) {
  EXPECT_EQ(status_text({{"state", "ready"}, {"warnings", {"a camera was swapped", 3}}}),
            "ready\n"
            "  warning: a camera was swapped\n"
            "  scans 0, ignored presses 0\n");
}

TEST(StatusText, SaysOnceWhySeveralLampsAreAway) {
  const json status = {{"state", "ready"},
                       {"outputs",
                        {output("lamp.ready", true, "there is no GPIO chip: plug it in"),
                         output("lamp.busy", false, "it does not answer: unplug it"),
                         output("lamp.fault", false, "there is no GPIO chip: plug it in"),
                         output("projector", false)}}};
  EXPECT_EQ(status_text(status),
            "ready\n"
            "  lamp.ready, lamp.fault there is no GPIO chip: plug it in\n"
            "  lamp.busy           it does not answer: unplug it\n"
            "  projector           off\n"
            "  scans 0, ignored presses 0\n");
}

TEST(StatusText, ShowsABarThatIsNeverLongerThanItsPlace) {
  const auto bar = [](const json& done) {
    const auto line = live_line({{"state", "measuring"}, {"stage", "girths"}, {"done", done}});
    return std::count(line.begin(), line.end(), '#');
  };
  EXPECT_EQ(bar(0.5), 15);
  EXPECT_EQ(bar(1.0), 30);
  EXPECT_EQ(bar(7.5e9), 30);
  EXPECT_EQ(bar(-1.0), 0);
  EXPECT_EQ(bar("half"), 0);
  EXPECT_EQ(live_line({{"state", "fault"}, {"trouble", "no pedal"}}), "\r\033[Kfault: no pedal");
}

TEST(StatusText, LeavesOutWhatIsOfTheWrongShape) {
  for (const char* odd :
       {"3", "[]", "{}",
        R"({"cameras": [3, {"frames": 3, "ok": "x"}], "outputs": [[], {"on": 1}]})",
        R"({"store": 3, "pedal": [{"trouble": "x"}]})",
        R"({"done": "x", "stage": "capture", "scans": -1, "outputs": 7})"}) {
    EXPECT_NO_THROW(static_cast<void>(status_text(json::parse(odd)))) << odd;
    EXPECT_NO_THROW(static_cast<void>(live_line(json::parse(odd)))) << odd;
  }
}

}  // namespace
}  // namespace instep
