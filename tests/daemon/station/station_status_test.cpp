#include "daemon/station/station_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/scan/scan_id.h"
#include "daemon/station/station.h"
#include "daemon/store/posix_storage.h"
#include "tests/support/loop_thread.h"
#include "tests/support/small_station.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kId = "20261121T091502417Z-k3f9";

/// A station whose scans give one empty result each.
class StationTold : public testing::Test {
 protected:
  /// What is under way still tells the station of itself, on the loop.
  ~StationTold() override { loop_.stop(); }

  void begin(const Settings& settings) {
    auto store = std::make_shared<ResultStore>(std::make_shared<PosixStorage>(), root_);
    ASSERT_TRUE(store->prepare());
    StationListener listener;
    listener.on_change = [] {};
    listener.on_failure = [](const Error&) {};
    listener.on_result = [](const std::vector<StoredResult>&) {};
    const auto measure = [](const Capture&, const PipelineSettings&, const ScanProgress&) {
      std::vector<ScanRecord> records(1);
      records[0].id = kId;
      return Result<std::vector<ScanRecord>>(records);
    };
    loop_.call([&] {
      station_.emplace(loop_.loop(), settings, measure, store, listener);
      station_->begin();
    });
  }

  test::TemporaryFolder folder_;
  std::filesystem::path root_ = folder_.path() / "scans";
  test::LoopThread loop_;
  std::optional<Station> station_;
};

// A camera that never started hid a pedal that was stuck, and a disk that was full.
TEST_F(StationTold, NamesEveryTroubleAndNotTheFirstAlone) {
  auto settings = test::small_station();
  settings.cameras[0].kind = CameraKind::kRecording;
  settings.cameras[0].path = folder_.path() / "no recording";
  settings.pedal.kind = PedalKind::kSimulated;
  settings.pedal.fifo = folder_.path() / "pedal";
  std::ofstream(settings.pedal.fifo) << "tap";
  begin(settings);
  loop_.call([&] {
    station_->store_failed({ErrorCode::kNoSpace, Remedy::kOperator, "the disk is full", ""});
  });
  ASSERT_TRUE(loop_.wait_until([&] { return station_->status().troubles.size() == 3; }));
  StationStatus status;
  loop_.call([&] { status = station_->status(); });
  EXPECT_THAT(status.troubles, ElementsAre(HasSubstr("no recording"), "the disk is full",
                                           HasSubstr("delete it, and it is made anew")));
  EXPECT_EQ(status.trouble(), status.troubles.front());
  ASSERT_TRUE(status.pedal && status.pedal->trouble);
  EXPECT_EQ(status.pedal->trouble->line(), status.troubles.back());
  EXPECT_EQ(status.store.root, root_);
  EXPECT_TRUE(status.store.trouble);
}

TEST_F(StationTold, HasNoLastResultOnceThatIsRemoved) {
  begin(test::small_station());
  ASSERT_TRUE(loop_.wait_until([&] { return station_->status().state == StationState::kReady; }));
  loop_.call([&] { EXPECT_TRUE(station_->request_scan()); });
  ASSERT_TRUE(loop_.wait_until([&] { return station_->status().last_result == kId; }));
  loop_.call([&] {
    station_->forget_result("20261121T091502417Z-aaaa");
    EXPECT_EQ(station_->status().last_result, kId);
    station_->forget_result(kId);
    EXPECT_EQ(station_->status().last_result, "");
  });
}

}  // namespace
}  // namespace instep
