#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "core/result.h"
#include "daemon/loop/task_thread.h"
#include "daemon/scan/scan_pipeline.h"
#include "daemon/station/camera_set.h"
#include "daemon/station/capture_remarks.h"
#include "daemon/station/devices.h"
#include "daemon/store/result_store.h"
#include "daemon/store/stored_result.h"

namespace instep {

/// measure_capture() of scan_pipeline.h, or what a test puts in its place.
using MeasureCapture = std::function<Result<std::vector<ScanRecord>>(
    const Capture&, const PipelineSettings&, const ScanProgress&)>;

/// What a scan works with. Shared, so that a scan that hangs can be left behind.
struct ScanTools {
  std::shared_ptr<CameraSet> cameras;
  CaptureSettings capture;
  PipelineSettings pipeline;
  std::optional<double> platform_height_mm;
  std::string calibration;
  bool simulated = false;
  /// As Capture::truth, once it is known; invalid if it never is. A scan that comes earlier waits.
  std::shared_future<std::map<std::string, double>> truth;
  MeasureCapture measure;
  std::shared_ptr<CaptureRemarks> remarks = std::make_shared<CaptureRemarks>();
  std::shared_ptr<ResultStore> store;
};

enum class ScanStep { kCaptured, kMeasured };

/// Told from the scan's thread how it goes.
struct ScanListener {
  std::function<void(ScanStep)> on_step;
  std::function<void(std::string_view stage, double done)> on_progress;  ///< done: 0 to 1
};

/// How a scan ended. `stored` holds all its feet, or none where one could not be written.
struct ScanOutcome {
  std::vector<StoredResult> stored;
  std::optional<Error> error;
  bool store_failed = false;
};

/// A whole scan on the calling thread: capture, measure, store. Ends soon after `cancelled` becomes
/// true, but not between two results. No exception leaves it.
ScanOutcome run_scan(const ScanTools& tools, const std::atomic<bool>& cancelled,
                     TaskProgress& progress, const ScanListener& listener);

}  // namespace instep
