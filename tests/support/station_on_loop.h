#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "daemon/scan/scan_id.h"
#include "daemon/station/station.h"
#include "daemon/store/posix_storage.h"
#include "tests/support/loop_thread.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {

/// A station at work on a loop of its own, which keeps its results in a folder of its own. A test
/// that has members which the station's scans or its listener use stops the loop in its destructor.
class StationOnLoop : public testing::Test {
 protected:
  /// What is under way still tells the station of itself, on the loop.
  ~StationOnLoop() override { loop_.stop(); }

  /// Sets what the station tells, and what its scans give: one empty result each.
  StationOnLoop() {
    listener_.on_change = [] {};
    listener_.on_failure = [](const Error&) {};
    listener_.on_result = [](const std::vector<StoredResult>&) {};
    measure_ = [](const Capture&, const PipelineSettings&, const ScanProgress&) {
      std::vector<ScanRecord> records(1);
      records[0].id = new_scan_ids(std::chrono::system_clock::now(), 1).at(0);
      return Result<std::vector<ScanRecord>>(records);
    };
  }

  void begin(const Settings& settings, OpenDevices open = open_devices_at_last(),
             OpenPedal opens_pedal = open_pedal) {
    auto store = std::make_shared<ResultStore>(std::make_shared<PosixStorage>(), root_);
    ASSERT_TRUE(store->prepare());
    loop_.call([&] {
      station_.emplace(loop_.loop(), settings, measure_, store, listener_, std::move(open),
                       std::move(opens_pedal));
      station_->begin();
    });
  }
  bool comes_to(StationState state) {
    return loop_.wait_until([&] { return station_->status().state == state; });
  }

  TemporaryFolder folder_;
  std::filesystem::path root_ = folder_.path() / "scans";
  LoopThread loop_;
  StationListener listener_;
  MeasureCapture measure_;
  std::optional<Station> station_;
};

}  // namespace instep::test
