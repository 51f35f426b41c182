#include "daemon/command_line/doctor/daemon_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "daemon/command_line/doctor/closed_check.h"
#include "daemon/control/control_client.h"
#include "daemon/control/protocol.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// It vouched for the folder of the settings, while scans went to the old one.
TEST(DaemonCheck, LooksAtTheStoreThatTheDaemonUses) {
  const test::TemporaryFolder folder;
  const auto told = [](const std::filesystem::path& root, const std::string& trouble) {
    return nlohmann::json{{"store", {{"root", root.string()}, {"trouble", trouble}}}};
  };
  const auto root = folder.path() / "scans";
  EXPECT_TRUE(check_store_of(told(root, ""), root, ::geteuid()).good);
  EXPECT_TRUE(check_store_of(nlohmann::json::object(), root, ::geteuid()).good)
      << "a daemon of an earlier version tells nothing";
  const auto old = check_store_of(told("/old", ""), root, ::geteuid());
  EXPECT_FALSE(old.good);
  EXPECT_THAT(old.finding, AllOf(HasSubstr("/old"), HasSubstr(root.string())));
  EXPECT_THAT(old.remedy,
              AllOf(HasSubstr("sudo systemctl restart instepd"), HasSubstr("INSTEP_STORE")));
  const auto roundabout = folder.path() / "." / "scans";
  EXPECT_TRUE(check_store_of(told(roundabout, ""), root, ::geteuid()).good);
  const auto gone = check_store_of(told(root, "it is gone"), root, ::geteuid());
  EXPECT_FALSE(gone.good);
  EXPECT_EQ(gone.finding, "it is gone");
}

TEST(DaemonCheck, AsksTheDaemonThatHasThePedal) {
  EXPECT_FALSE(check_pedal_of(json::object()));
  EXPECT_FALSE(check_pedal_of({{"pedal", nullptr}})) << "there is to be none";
  EXPECT_TRUE(check_pedal_of({{"pedal", {{"ok", true}, {"trouble", ""}}}})->good);
  const auto stuck = check_pedal_of({{"pedal", {{"ok", false}, {"trouble", "it is stuck"}}}});
  ASSERT_TRUE(stuck);
  EXPECT_FALSE(stuck->good);
  EXPECT_EQ(stuck->finding, "it is stuck");
}

// systemctl start does nothing for a unit that runs.
TEST(DaemonCheck, RestartsADaemonThatHangsAndStartsOneThatIsNotThere) {
  EXPECT_THAT(check_daemon(fail(ErrorCode::kTimeout, "it did not answer", "look"), "/run/s").remedy,
              HasSubstr("systemctl restart"));
  const test::TemporaryFolder folder;
  const auto none = ControlClient::connect(folder.path() / "control.sock");
  ASSERT_FALSE(none);
  EXPECT_THAT(check_daemon(tl::make_unexpected(none.error()), "/run/s").remedy,
              HasSubstr("sudo systemctl start instepd"));
}

/// It had whoever might not ask it believe that it was wrong.
TEST(DaemonCheck, IsNotWrongWhereWhoeverAsksMayNotAskIt) {
  const auto check =
      check_daemon(fail(ErrorCode::kPermissionDenied, "you may not", "join its group"), "/run/s");
  EXPECT_FALSE(check.good);
  EXPECT_EQ(check.is_wrong(), installed_user() == ::geteuid());
}

/// A status with these troubles of its parts, as the daemon itself tells it.
json told(const std::optional<Error>& camera, const std::optional<Error>& pedal,
          const std::optional<Error>& store) {
  StationStatus status;
  status.state = StationState::kFault;
  status.cameras = {{"left", "Model"}, {"right", "Model"}};
  status.cameras[0].trouble = camera;
  status.pedal = {pedal};
  status.store = {"/scans", store};
  for (const auto& trouble : {camera, store, pedal}) {
    if (trouble) status.troubles.push_back({*trouble});
  }
  return to_json(status);
}

/// The findings and remedies of all that is bad.
std::vector<std::string> all_bad(json status, const VideoTroubles& video) {
  const test::TemporaryFolder root;
  status["store"]["root"] = root.path().string();
  std::vector<DoctorCheck> checks = check_cameras_of(status, video);
  const auto shown = check_video_cameras(video, std::nullopt);
  checks.insert(checks.end(), shown.begin(), shown.end());
  checks.push_back(check_daemon(status, "/run/s"));
  checks.push_back(check_store_of(status, root.path(), ::geteuid()));
  checks.push_back(*check_pedal_of(status));
  std::vector<std::string> lines;
  for (const auto& check : checks) {
    if (!check.good) lines.push_back(check.name + " " + check.finding + " -> " + check.remedy);
  }
  return lines;
}

const Error kAway{ErrorCode::kDeviceGone, Remedy::kReopen, "camera left: it is away", "plug it in"};
const Error kStuck{ErrorCode::kBusy, Remedy::kOperator, "the pedal is stuck", "take the foot off"};
const Error kFull{ErrorCode::kNoSpace, Remedy::kOperator, "the disk is full", "make room"};

/// A camera that was away stood there as the daemon's trouble, as its own and as the kernel's, with
/// a remedy each.
TEST(DaemonCheck, TellsEachFaultOnceWithOneRemedy) {
  EXPECT_THAT(all_bad(told(kAway, kStuck, kFull), {}),
              ElementsAre("camera camera left: it is away -> plug it in",
                          "store the disk is full -> make room",
                          "pedal the pedal is stuck -> take the foot off"));
  const VideoTroubles video{
      {"left", DeviceTrouble{"no driver serves it", "sudo modprobe uvcvideo"}},
      {"right", std::nullopt}};
  EXPECT_THAT(all_bad(told(kAway, std::nullopt, std::nullopt), video),
              ElementsAre("camera left: no driver serves it -> sudo modprobe uvcvideo"));
  const VideoTroubles none_shown{{"left", std::nullopt}, {"right", std::nullopt}};
  EXPECT_THAT(all_bad(told(kAway, std::nullopt, std::nullopt), none_shown),
              ElementsAre("camera camera left: it is away -> plug it in"))
      << "of which the kernel knows nothing";
}

/// A camera that the daemon had open was wrong for whoever might not open it.
TEST(DaemonCheck, LeavesToTheDaemonACameraThatWhoeverAsksMayNotOpen) {
  const VideoTroubles closed{
      {"left", DeviceTrouble{"/dev/video0 cannot be opened", "join the group", true}},
      {"right", DeviceTrouble{"it is on a slow link", "plug it in elsewhere"}},
      {"new", DeviceTrouble{"/dev/video9 cannot be opened", "join the group", true}}};
  for (const auto& trouble : {std::optional<Error>(), std::optional(kAway)}) {
    const auto video = without_those_of(told(trouble, std::nullopt, std::nullopt), closed);
    EXPECT_FALSE(video.contains("left"));
    EXPECT_TRUE(video.at("right").has_value()) << "which the daemon does not tell";
    EXPECT_TRUE(video.contains("new")) << "which the daemon does not know";
  }
  const auto away = told(kAway, std::nullopt, std::nullopt);
  EXPECT_THAT(all_bad(away, without_those_of(away, {{"left", closed.at("left")}})),
              ElementsAre("camera camera left: it is away -> plug it in"));
  const auto unknown = check_video_cameras({{"new", closed.at("new")}}, ::geteuid() + 1);
  ASSERT_EQ(unknown.size(), 1U);
  EXPECT_TRUE(unknown[0].unseen);
  EXPECT_THAT(unknown[0].finding, HasSubstr("new: /dev/video9"));
}

/// Of those that come before it nobody was told while the first one was away.
TEST(DaemonCheck, NamesEveryCameraThatDoesNotAnswer) {
  auto status = told(kAway, std::nullopt, std::nullopt);
  status["cameras"][1]["ok"] = false;
  status["cameras"][1]["trouble"] = "camera right does not answer";
  const auto checks = check_cameras_of(status, {});
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_EQ(checks[1].finding, "camera right does not answer");
  EXPECT_THAT(checks[1].remedy, HasSubstr("instep status"));
  const auto well = check_cameras_of(told({}, {}, {}), {});
  ASSERT_EQ(well.size(), 1U);
  EXPECT_EQ(well[0].finding, "all 2 answer");
}

TEST(DaemonCheck, TellsWhatNoPartTells) {
  StationStatus status;
  status.state = StationState::kDegraded;
  EXPECT_THAT(check_cameras_of(to_json(status), {})[0].finding, HasSubstr("none is open"));
  const Error silent{ErrorCode::kTimeout, Remedy::kOperator, "the pedal does not answer", "see"};
  status.pedal = {silent};
  status.troubles = {{silent}};
  EXPECT_THAT(check_cameras_of(to_json(status), {})[0].finding, HasSubstr("none is open"))
      << "a pedal is no reason";
  status.pedal.reset();
  const Error away{ErrorCode::kNotFound, Remedy::kReopen,
                   "camera left: the sensor 123 is not plugged in", "plug it in"};
  status.troubles = {{away, "left"}};
  const auto daemon = check_daemon(to_json(status), "/run/s");
  EXPECT_FALSE(daemon.good);
  EXPECT_EQ(daemon.finding, "degraded: " + away.line());
  EXPECT_THAT(check_cameras_of(to_json(status), {}), IsEmpty()) << "which that explains";
}

/// They were to be plugged in, though they were.
TEST(DaemonCheck, HasNobodyPlugCamerasInThatAreBeingOpened) {
  StationStatus status;
  status.state = StationState::kStarting;
  const auto checks = check_cameras_of(to_json(status), {});
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_FALSE(checks[0].good);
  EXPECT_EQ(checks[0].remedy, "instep status --wait-ready 60");
}

TEST(DaemonCheck, OutlivesAStatusOfAnotherShape) {
  for (const char* text :
       {"3", "[]", "{}", R"({"cameras":3,"pedal":[],"store":"x","troubles":[1],"outputs":{}})",
        R"({"cameras":[7,{"id":3,"ok":"x"}],"outputs":[4]})"}) {
    const auto status = json::parse(text);
    EXPECT_NO_THROW((void)check_daemon(status, "/run/s")) << text;
    EXPECT_NO_THROW((void)check_cameras_of(status, {})) << text;
    EXPECT_NO_THROW((void)check_store_of(status, "/none", 0)) << text;
    EXPECT_NO_THROW((void)check_pedal_of(status)) << text;
    EXPECT_NO_THROW((void)outputs_of(status)) << text;
  }
}

/// A board that is away was told of as often as it has lamps.
TEST(OutputCheck, NamesLampsThatAreAwayForOneCauseTogether) {
  const auto checks = check_outputs({{"lamp.ready", "there is no chip", "plug it in"},
                                     {"lamp.busy", "", ""},
                                     {"projector", "there is no chip", "plug it in"}},
                                    "is there");
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_EQ(checks[0].finding, "lamp.ready, projector: there is no chip");
  EXPECT_EQ(checks[0].remedy, "plug it in");
  EXPECT_EQ(checks[1].finding, "lamp.busy is there");
}

TEST(OutputCheck, IsNotWrongForWantOfRightsOfWhoeverAsks) {
  const auto checks =
      check_outputs({{"lamp.ready", "this user may not open it", "join", true}}, "can be opened");
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_TRUE(checks[0].unseen);
  EXPECT_THAT(checks[0].finding, HasSubstr("lamp.ready: this user may not open it"));
}

}  // namespace
}  // namespace instep
