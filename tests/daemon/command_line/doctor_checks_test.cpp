#include "daemon/command_line/doctor_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pwd.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "daemon/control/control_client.h"
#include "daemon/machine/folder_rights.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

CameraSettings camera(const std::string& name, bool is_rough) {
  CameraSettings camera;
  camera.kind = CameraKind::kOpenni;
  camera.openni.placement.name = name;
  camera.openni.placement.is_rough = is_rough;
  return camera;
}

AppliedCalibration calibration_of(std::vector<std::string> placed,
                                  std::vector<std::string> left_out) {
  return {"/etc/c.toml", "2026-11-28T02:11:12Z", std::move(placed), std::move(left_out), {}};
}

TEST(CalibrationCheck, IsNotMadeWhereThereIsNothingToCalibrate) {
  Settings settings;
  EXPECT_FALSE(check_calibration(settings, {}));
  settings.cameras.resize(2);  // simulated ones
  EXPECT_FALSE(check_calibration(settings, {}));
  settings.calibration = calibration_of({}, {});
  EXPECT_FALSE(check_calibration(settings, {}));
  settings.calibration.reset();
  settings.cameras = {camera("left", false)};
  EXPECT_FALSE(check_calibration(settings, {})) << "one camera alone";
}

TEST(CalibrationCheck, NamesTheCommandWherePosesAreTheSettingsOwn) {
  Settings settings;
  settings.cameras = {camera("left", false), camera("right", false)};
  const auto check = check_calibration(settings, {});
  ASSERT_TRUE(check);
  EXPECT_TRUE(check->good);
  EXPECT_THAT(check->finding, HasSubstr("instep calibrate"));
}

TEST(CalibrationCheck, IsBadWhereATapeMeasureIsAllThatThereIs) {
  Settings settings;
  settings.cameras = {camera("left", false), camera("right", true)};
  const auto check = check_calibration(settings, {});
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->good);
  EXPECT_THAT(check->finding, HasSubstr("by tape measure alone: right"));
  EXPECT_EQ(check->remedy, "instep calibrate");
  settings.cameras = {camera("only", true)};  // its tilt and its height are found
  const auto alone = check_calibration(settings, {});
  ASSERT_TRUE(alone);
  EXPECT_FALSE(alone->good);
}

TEST(CalibrationCheck, IsBadForCamerasThatTheCalibrationLeftOut) {
  Settings settings;
  settings.cameras = {camera("left", false), camera("right", false)};
  settings.calibration = calibration_of({"left"}, {"right"});
  const auto check = check_calibration(settings, {});
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->good);
  EXPECT_THAT(check->finding, AllOf(HasSubstr("/etc/c.toml"), HasSubstr("right")));
  EXPECT_EQ(check->remedy, "instep calibrate");
}

TEST(CalibrationCheck, IsBadWhereAnotherUnitThanTheCalibratedOneAnswers) {
  Settings settings;
  settings.cameras = {camera("left", false), camera("right", false)};
  settings.calibration = calibration_of({"left", "right"}, {});
  settings.calibration->serials = {{"left", "111"}, {"right", "222"}};
  EXPECT_TRUE(check_calibration(settings, {{"left", "111"}, {"right", ""}})->good);
  const auto check = check_calibration(settings, {{"left", "111"}, {"right", "333"}});
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->good);
  EXPECT_THAT(check->finding, HasSubstr("right is the unit 333, and 222 was calibrated"));
  EXPECT_EQ(check->remedy, "instep calibrate");
}

TEST(CalibrationCheck, SaysWhenAllWereCalibrated) {
  Settings settings;
  settings.cameras = {camera("left", false), camera("right", false)};
  settings.calibration = calibration_of({"left", "right"}, {});
  const auto check = check_calibration(settings, {});
  ASSERT_TRUE(check);
  EXPECT_TRUE(check->good);
  EXPECT_THAT(check->finding, HasSubstr("2026-11-28T02:11:12Z"));
}

/// It vouched for the folder of the settings, while scans went to the old one.
TEST(StoreCheck, LooksAtTheStoreThatTheDaemonUses) {
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

TEST(PedalCheck, AsksTheDaemonThatHasThePedal) {
  using nlohmann::json;
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

/// As somebody finds it who owns nothing: that thread alone is another user's.
DoctorCheck check_of_stranger(const std::filesystem::path& store, std::optional<uid_t> daemon) {
  constexpr int kNobody = 65534;
  DoctorCheck check;
  std::thread([&] {
    ::syscall(SYS_setresuid, kNobody, kNobody, kNobody);
    check = check_store(store, daemon);
  }).join();
  return check;
}

TEST(StoreCheck, NeedsNoRightOfWhoeverAsks) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs the right to give a folder away";
  const test::TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  const auto store = folder.path() / "store";
  std::filesystem::create_directory(store);
  std::filesystem::permissions(store, std::filesystem::perms(0755));
  const auto roots = check_of_stranger(store, std::nullopt);
  EXPECT_FALSE(roots.good) << "no daemon runs as root";
  EXPECT_THAT(roots.finding, HasSubstr("the daemon may not write"));
  EXPECT_THAT(roots.remedy, testing::Not(HasSubstr("usermod")));
  EXPECT_TRUE(check_of_stranger(store, 0).good);
  const auto of_another = check_of_stranger(store, 1);  // a store that the running one cannot use
  EXPECT_FALSE(of_another.good);
  EXPECT_THAT(of_another.remedy, HasSubstr("sudo chown " + user_name(1)));

  const auto* daemon = ::getpwnam("instep");
  ASSERT_EQ(::chown(store.c_str(), daemon != nullptr ? daemon->pw_uid : 1, 1), 0);
  std::filesystem::permissions(store, std::filesystem::perms(0750));
  const auto daemons = check_of_stranger(store, std::nullopt);
  EXPECT_TRUE(daemons.good) << daemons.finding;
  std::filesystem::permissions(store, std::filesystem::perms(0550));
  EXPECT_FALSE(check_of_stranger(store, std::nullopt).good) << "its owner may not write either";
}

}  // namespace
}  // namespace instep
