#include "daemon/station/scan_session.h"

#include <malloc.h>

#include <utility>

#include "core/go_on.h"
#include "daemon/loop/caught.h"
#include "daemon/store/put_together.h"

namespace instep {
namespace {

/// Of the whole scan, the part that is over when all frames are there.
constexpr double kCaptureShare = 0.3;
constexpr double kMeasureShare = 0.6;
constexpr std::chrono::milliseconds kTruthLook{20};

class ScanSession {
 public:
  ScanSession(const ScanTools& tools, const std::atomic<bool>& cancelled, TaskProgress& progress,
              const ScanListener& listener)
      : tools_(tools), cancelled_(cancelled), progress_(progress), listener_(listener) {}

  ScanOutcome run() {
    const auto capture = take_capture();
    if (!capture) return failed(capture.error());
    listener_.on_step(ScanStep::kCaptured);

    const auto records = measure(*capture);
    if (!records) return failed(records.error());
    listener_.on_step(ScanStep::kMeasured);

    return store(*records);
  }

 private:
  Result<Capture> take_capture() {
    tell("capture", 0.0);
    const auto faulty_before = tools_.cameras->faulty_frames();
    auto frames = tools_.cameras->capture(tools_.capture, [this] {
      progress_.step();
      return !cancelled_;
    });
    if (!frames) return tl::make_unexpected(frames.error());
    Capture capture;
    capture.cameras = tools_.cameras->descriptions();
    capture.frames = std::move(*frames);
    capture.frames_rejected = tools_.cameras->faulty_frames() - faulty_before;
    capture.platform_height_mm = tools_.platform_height_mm;
    capture.simulated = tools_.simulated;
    capture.calibration = tools_.calibration;
    if (auto known = wait_for_truth(); !known) return tl::make_unexpected(known.error());
    if (tools_.truth.valid()) capture.truth = tools_.truth.get();
    return capture;
  }

  /// Only the first scans of a simulated station ever wait here.
  Result<void> wait_for_truth() {
    while (tools_.truth.valid() && tools_.truth.wait_for(kTruthLook) != std::future_status::ready) {
      progress_.step();
      if (cancelled_) return cancelled();
    }
    return {};
  }

  Result<std::vector<ScanRecord>> measure(const Capture& capture) {
    const auto remarks = tools_.remarks->all();
    auto pipeline = tools_.pipeline;
    pipeline.ids_from = tools_.store->time_of_next(std::chrono::system_clock::now());
    auto records = tools_.measure(capture, pipeline, [this](std::string_view stage, double done) {
      progress_.step();
      tell(stage, kCaptureShare + kMeasureShare * done);
      return !cancelled_;
    });
    if (!records) return records;
    for (auto& record : *records) {
      record.warnings.insert(record.warnings.begin(), remarks.begin(), remarks.end());
    }
    return records;
  }

  /// Each stage once, however many pieces it has.
  void tell(std::string_view stage, double done) {
    if (stage == told_stage_ && done == told_done_) return;
    told_stage_ = stage;
    told_done_ = done;
    listener_.on_progress(stage, done);
  }

  ScanOutcome store(const std::vector<ScanRecord>& records) {
    tell("store", kCaptureShare + kMeasureShare);
    std::vector<NamedContent> results;
    for (const auto& record : records) {
      progress_.step();
      auto content = content_of(record);
      if (!content) return failed(content.error());
      results.push_back({record.id, std::move(*content)});
    }
    const auto folders = put_together(*tools_.store, results, [&] { progress_.step(); });
    ScanOutcome outcome;
    if (!folders) {
      outcome.error = folders.error();
      outcome.store_failed = true;
      return outcome;
    }
    for (std::size_t i = 0; i < records.size(); ++i) {
      outcome.stored.push_back({records[i].id, (*folders)[i], records[i].foot.side});
    }
    tell("done", 1.0);
    return outcome;
  }

  static ScanOutcome failed(const Error& error) {
    ScanOutcome outcome;
    outcome.error = error;
    return outcome;
  }

  const ScanTools& tools_;
  const std::atomic<bool>& cancelled_;
  TaskProgress& progress_;
  const ScanListener& listener_;
  std::string told_stage_;
  double told_done_ = 0.0;
};

}  // namespace

ScanOutcome run_scan(const ScanTools& tools, const std::atomic<bool>& cancelled,
                     TaskProgress& progress, const ScanListener& listener) {
  ScanOutcome outcome;
  try {
    outcome = ScanSession(tools, cancelled, progress, listener).run();
  } catch (...) {
    outcome.error = error_of_thrown("the scan");
  }
  // The frames of a scan are most of this process: they go back to the system at once.
  malloc_trim(0);
  return outcome;
}

}  // namespace instep
