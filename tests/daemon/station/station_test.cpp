#include "daemon/station/station.h"

#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "daemon/scan/scan_id.h"
#include "daemon/store/posix_storage.h"
#include "tests/support/loop_thread.h"
#include "tests/support/scripted_camera.h"
#include "tests/support/small_station.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using test::ScriptedCamera;
using Step = ScriptedCamera::Step;

/// A station with one camera that does what its script says, and whose scans give one empty result.
class ScriptedStation : public testing::Test {
 protected:
  ~ScriptedStation() override { loop_.stop(); }

  /// Neither a look nor a frame has to come in time, and no look comes by itself.
  static Settings patient() {
    auto settings = test::small_station();
    settings.capture.frame_limit = 1h;
    settings.capture.deadline = 1h;
    settings.capture.check_every = 3600s;
    return settings;
  }

  void begin(const Settings& settings, std::deque<Step> script) {
    auto store = std::make_shared<ResultStore>(std::make_shared<PosixStorage>(), folder_.path());
    ASSERT_TRUE(store->prepare());
    StationListener listener;
    listener.on_change = [] {};
    listener.on_failure = [](const Error&) {};
    listener.on_result = [](const std::vector<StoredResult>&) {};
    const auto measure = [](const Capture&, const PipelineSettings&, const ScanProgress&) {
      std::vector<ScanRecord> records(1);
      records[0].id = new_scan_ids(std::chrono::system_clock::now(), 1).at(0);
      return Result<std::vector<ScanRecord>>(records);
    };
    auto owned = std::make_unique<ScriptedCamera>("left", std::move(script));
    camera_ = owned.get();
    const auto cameras = std::make_shared<std::unique_ptr<DepthCamera>>(std::move(owned));
    const auto open = [cameras](const Settings&) {
      Devices devices;
      devices.cameras.push_back(std::move(*cameras));
      return Result<Devices>(std::move(devices));
    };
    loop_.call([&] {
      station_.emplace(loop_.loop(), settings, measure, store, listener, open);
      station_->begin();
    });
  }
  bool comes_to(StationState state) {
    return loop_.wait_until([&] { return station_->status().state == state; });
  }

  test::TemporaryFolder folder_;
  test::LoopThread loop_;
  ScriptedCamera* camera_ = nullptr;
  std::optional<Station> station_;
};

/// It refused every scan for the time between two looks, though its camera had just given one.
TEST_F(ScriptedStation, IsReadyAfterAScanThoughALookThatCameBeforeItFails) {
  begin(patient(), {Step::kGood, Step::kHang});
  ASSERT_TRUE(comes_to(StationState::kReady));
  loop_.call([&] { station_->reload(patient()); });
  camera_->wait_until_asked(2);
  loop_.call([&] { EXPECT_TRUE(station_->request_scan()); });
  camera_->release();
  StationStatus after;
  ASSERT_TRUE(loop_.wait_until([&] {
    after = station_->status();
    return after.scans == 1;
  }));
  EXPECT_EQ(after.state, StationState::kReady) << after.trouble();
  // For two looks, the scan, and the look that is made again.
  const auto capture = patient().capture;
  camera_->wait_until_asked(2 + capture.warmup_frames + capture.frames_per_camera + 1);
}

/// Its store's trouble was told, which kept nobody from scanning, with a remedy that was no help.
TEST_F(ScriptedStation, SaysThatItIsStartingWhateverElseIsWrong) {
  begin(patient(), {Step::kHang});
  camera_->wait_until_asked();
  loop_.call([&] {
    station_->store_failed({ErrorCode::kNoSpace, Remedy::kOperator, "the disk is full", ""});
    const auto asked = station_->request_scan();
    ASSERT_FALSE(asked);
    EXPECT_EQ(asked.error().message, "the station is starting");
    EXPECT_EQ(asked.error().remedy, Remedy::kRetry);
  });
  camera_->release();
}

/// It was told at the start alone, whatever was read later.
TEST_F(ScriptedStation, WarnsOfADeadlineThatIsTooShortForAScanForAsLongAsItIs) {
  auto settings = patient();
  settings.cameras[0].kind = CameraKind::kRecording;
  begin(settings, {});
  auto late = settings;
  late.capture.frames_per_camera = 120;
  late.capture.deadline = 1s;
  loop_.call([&] {
    EXPECT_TRUE(station_->status().warnings.empty());
    station_->reload(late);
    ASSERT_EQ(station_->status().warnings.size(), 1U);
    EXPECT_EQ(station_->status().warnings[0].rfind("capture.deadline_ms = 1000 is too short", 0),
              0U);
    station_->reload(settings);
    EXPECT_TRUE(station_->status().warnings.empty());
  });
}

}  // namespace
}  // namespace instep
