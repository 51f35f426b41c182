#include "daemon/station/station.h"

#include <algorithm>
#include <utility>

#include "config/calibration/warnings_of_poses.h"
#include "config/capture_time.h"
#include "daemon/station/pipeline_settings.h"
#include "daemon/station/truth_of_simulation.h"

namespace instep {
namespace {

/// Of a scan that nobody cancelled, too.
Error stopping() {
  return {ErrorCode::kCancelled, Remedy::kRetry, "the station is stopping",
          "scan once instepd runs again"};
}

}  // namespace

Station::Station(EventLoop& loop, Settings settings, MeasureCapture measure,
                 std::shared_ptr<ResultStore> store, StationListener listener, OpenDevices open,
                 OpenPedal opens_pedal)
    : loop_(loop),
      settings_(std::move(settings)),
      measure_(std::move(measure)),
      store_(std::move(store)),
      listener_(std::move(listener)),
      open_devices_(std::move(open)),
      open_pedal_(std::move(opens_pedal)) {
  open_timer_ = loop_.timer([this] { open_devices_again(); });
}

Station::~Station() {
  if (cancelled_) *cancelled_ = true;
  looks_.reset();
  cameras_.reset();
}

void Station::begin() {
  signals_.emplace(loop_, settings_.outputs, open_output, [this] {
    remark_missing_light();
    listener_.on_change();
  });
  signals_->show(machine_.state());
  open_devices_again();
  pedal_.emplace(
      loop_, settings_.pedal, [settings = settings_, open = open_pedal_] { return open(settings); },
      PedalWatch::Listener{[this](PedalSignal signal) { pedal_signalled(signal); },
                           [this](const Error& error) { pedal_lost(error); },
                           [this] { pedal_returned(); }});
}

void Station::store_failed(const Error& error) {
  if (machine_.state() != StationState::kStoring) note_store_failure(error);
}

void Station::note_store_failure(const Error& error) {
  ++store_failures_;
  store_trouble_ = error;
  handle(StationEvent::kStoreFailed);
}

std::optional<std::uint64_t> Station::store_trouble() const {
  return store_trouble_ ? std::optional(store_failures_) : std::nullopt;
}

void Station::store_tried_out(std::uint64_t trouble, const Result<void>& outcome) {
  if (store_trouble() != trouble) return;
  store_trouble_ = outcome ? std::nullopt : std::optional(outcome.error());
  outcome ? handle(StationEvent::kStoreReady) : listener_.on_change();
}

Result<void> Station::request_scan() {
  if (machine_.is_busy()) {
    handle(StationEvent::kScanRequested);
    return fail(ErrorCode::kBusy, "a scan is under way", "wait for it, or cancel it");
  }
  handle(StationEvent::kScanRequested);
  if (machine_.is_busy()) return {};
  return tl::make_unexpected(refusal());
}

Result<void> Station::request_cancel() {
  const auto state = machine_.state();
  if (state != StationState::kCapturing && state != StationState::kMeasuring) {
    return fail(ErrorCode::kNotFound, "there is no scan to cancel",
                "start one with the pedal or instep scan");
  }
  handle(StationEvent::kCancelRequested);
  return {};
}

void Station::reload(const Settings& settings) {
  settings_.station = settings.station;
  settings_.capture = settings.capture;
  settings_.sizes = settings.sizes;
  settings_.measures = settings.measures;
  settings_.pedal.debounce = settings.pedal.debounce;
  settings_.pedal.hold_to_cancel = settings.pedal.hold_to_cancel;
  if (pedal_) pedal_->set(settings_.pedal);
  if (!looks_) return;
  looks_->set(settings_.capture);
  looks_->look();  // and from then on as often as is wanted now
}

void Station::shut_down() {
  handle(StationEvent::kShutdown);
}

std::vector<std::string> Station::end_by(std::chrono::steady_clock::time_point deadline) {
  if (signals_) signals_->put_off();
  if (pedal_) pedal_->put_off();
  if (care_) care_->put_off_watch();
  if (cancelled_) *cancelled_ = true;
  std::vector<std::string> left_behind;
  const auto note = [&](const char* what, bool ended) {
    if (!ended) left_behind.emplace_back(what);
  };
  note("a camera", !cameras_ || cameras_->end_by(deadline));
  note("the scan", scan_thread_.stop_by(deadline));
  note("the truth of the simulation", truth_thread_.stop_by(deadline));
  note("the pedal", !pedal_ || pedal_->end_by(deadline));
  note("the watch of the USB bus", !care_ || care_->end_watch_by(deadline));
  note("the reset of a camera", !care_ || care_->end_by(deadline));
  note("a lamp or the projector", !signals_ || signals_->finish());
  return left_behind;
}

StationStatus Station::status() const {
  StationStatus status;
  status.state = machine_.state();
  status.cameras = camera_status();
  status.troubles = troubles(status.cameras);
  status.warnings = pose_warnings(status.cameras);
  const std::string late = warning_of_short_deadline(settings_);
  if (!late.empty()) status.warnings.push_back(late);
  status.stage = stage_;
  status.done = done_;
  if (settings_.pedal.kind != PedalKind::kNone) status.pedal = {pedal_trouble_};
  status.store = {store_->root(), store_trouble_};
  if (signals_) status.outputs = signals_->status();
  status.scans = scans_;
  status.ignored_presses = machine_.ignored_presses();
  status.last_result = last_result_;
  return status;
}

std::vector<CameraStatus> Station::camera_status() const {
  std::vector<CameraStatus> all;
  if (!cameras_) return all;
  for (const auto& camera : cameras_->descriptions()) {
    const std::size_t i = all.size();
    all.push_back({camera.geometry.id, camera.model, camera.serial, looks_->trouble(i),
                   care_->health(i), cameras_->frame_counts(i)});
  }
  return all;
}

void Station::forget_result(const std::string& id) {
  if (last_result_ != id) return;
  last_result_.clear();
  listener_.on_change();
}

void Station::note_progress(ProgressWatch& watch) const {
  // Opening devices is one long call that tells no steps, and a disk that stalls holds up storing:
  // to be killed then would cost a scan that is measured. The state shows that it goes on.
  const bool is_one_call = opening_ || machine_.state() == StationState::kStoring;
  watch.note("scan", scan_thread_.is_busy() && !is_one_call, scan_thread_.progress());
  if (cameras_) cameras_->note_progress(watch);
}

void Station::handle(StationEvent event) {
  const auto actions = machine_.handle(event);
  // Before the cameras start: their frames are to be lit.
  if (signals_) signals_->show(machine_.state());
  for (const auto action : actions) act(action);
  listener_.on_change();
}

void Station::act(StationAction action) {
  switch (action) {
    case StationAction::kStartScan:
      return start_scan();
    case StationAction::kCancelScan:
      *cancelled_ = true;
      return;
    case StationAction::kRefuseScan:
      return listener_.on_failure(refusal());
    case StationAction::kIgnorePress:
      return listener_.on_ignored_press(machine_.ignored_presses());
    case StationAction::kAnnounceResult:
      return listener_.on_result(outcome_.stored);
    case StationAction::kAnnounceFailure:
      return listener_.on_failure(*outcome_.error);
    case StationAction::kAnnounceCancelled:
      return listener_.on_failure(machine_.is_leaving() ? stopping() : *outcome_.error);
    case StationAction::kLeave:
      return listener_.on_left();
  }
}

void Station::open_devices_again() {
  opening_ = true;
  scan_thread_.post(
      [this, post = loop_.poster(), open = open_devices_, settings = settings_](TaskProgress&) {
        auto devices = std::make_shared<OpenedDevices>(open(settings));
        post([this, devices] { take_devices(std::move(*devices)); });
      });
}

void Station::take_devices(OpenedDevices devices) {
  opening_ = false;
  if (!devices) {
    opening_troubles_ = std::move(devices.error().sources);
    open_timer_.set(open_back_off_.next());
    return handle(StationEvent::kCamerasLost);
  }
  opening_troubles_.clear();
  devices_ = std::move(*devices);
  cameras_ = std::make_shared<CameraSet>(std::exchange(devices_.cameras, {}));
  begin_care();
  truth_ = truth_of_simulation(truth_thread_, devices_.work_out_truth);
  // The projector is lit for scans alone.
  const auto zero_frames = settings_.outputs.projector ? CameraSet::ZeroFrames::kAreAsExpected
                                                       : CameraSet::ZeroFrames::kAreFaulty;
  looks_.emplace(loop_, cameras_, settings_.capture, zero_frames, [this] { cameras_looked_at(); });
  looks_->look();
}

void Station::begin_care() {
  std::vector<std::optional<UsbAddress>> addresses;
  for (const auto& camera : cameras_->descriptions()) {
    const auto usb = devices_.usb.find(camera.geometry.id);
    addresses.push_back(usb == devices_.usb.end() ? std::nullopt : std::optional(usb->second));
  }
  care_.emplace(loop_, addresses,
                CameraCare::Listener{[this] { looks_->look(); }, listener_.on_change});
}

void Station::cameras_looked_at() {
  for (std::size_t i = 0; i < cameras_->size(); ++i) care_->looked_at(i, looks_->trouble(i));
  handle(looks_->all_answer() ? StationEvent::kCamerasReady : StationEvent::kCamerasLost);
}

void Station::pedal_signalled(PedalSignal signal) {
  switch (signal) {
    case PedalSignal::kPressed:
      return handle(StationEvent::kScanRequested);
    case PedalSignal::kHeld:
      return handle(StationEvent::kCancelRequested);
    case PedalSignal::kStuck:
      return pedal_lost(stuck_pedal());
    case PedalSignal::kChattering:
      return pedal_lost(chattering_pedal());
    case PedalSignal::kReleased:
      return pedal_returned();
  }
}

void Station::pedal_lost(const Error& error) {
  pedal_trouble_ = error;
  handle(StationEvent::kPedalFault);
}

void Station::pedal_returned() {
  // It may tell nothing new: that a foot has left it.
  if (!pedal_trouble_ && machine_.knows_pedal()) return;
  pedal_trouble_.reset();
  handle(StationEvent::kPedalReady);
}

ScanTools Station::tools() const {
  ScanTools tools;
  tools.cameras = cameras_;
  tools.capture = settings_.capture;
  tools.pipeline = pipeline_settings(settings_);
  tools.platform_height_mm = platform_height_mm(settings_, devices_);
  tools.calibration = devices_.calibration;
  tools.simulated = devices_.simulated;
  tools.truth = truth_;
  tools.measure = measure_;
  tools.remarks = remarks_;
  tools.store = store_;
  return tools;
}

void Station::remark_missing_light() {
  if (machine_.state() != StationState::kCapturing || !signals_ || !remarks_) return;
  if (const auto trouble = signals_->light_trouble()) {
    remarks_->note("the projector was not lit for the whole capture: " + trouble->line());
  }
}

void Station::remark_poses() {
  for (const auto& warning : pose_warnings(camera_status())) remarks_->note(warning);
}

std::vector<std::string> Station::pose_warnings(const std::vector<CameraStatus>& cameras) const {
  ToldSerials told;
  for (const auto& camera : cameras) told[camera.id] = camera.serial;
  return warnings_of_poses(settings_, told);
}

void Station::start_scan() {
  remarks_ = std::make_shared<CaptureRemarks>();
  remark_missing_light();
  remark_poses();
  cancelled_ = std::make_shared<std::atomic<bool>>(false);
  looks_->pause();
  stage_ = "capture";
  done_ = 0.0;
  const auto post = loop_.poster();
  ScanListener listener;
  listener.on_step = [this, post](ScanStep step) {
    post([this, step] {
      handle(step == ScanStep::kCaptured ? StationEvent::kCaptured : StationEvent::kMeasured);
    });
  };
  listener.on_progress = [this, post](std::string_view stage, double done) {
    post([this, stage = std::string(stage), done] {
      stage_ = stage;
      done_ = done;
      listener_.on_change();
    });
  };
  scan_thread_.post([this, post, tools = tools(), cancelled = cancelled_,
                     listener](TaskProgress& progress) {
    auto outcome = std::make_shared<ScanOutcome>(run_scan(tools, *cancelled, progress, listener));
    post([this, outcome] { scan_ended(*outcome); });
  });
}

void Station::scan_ended(const ScanOutcome& outcome) {
  outcome_ = outcome;
  stage_.clear();
  done_ = 0.0;
  // A scan that failed may have lost a camera: that is looked into at once.
  const bool failed = outcome.error && outcome.error->code != ErrorCode::kCancelled;
  looks_->resume(failed);
  if (!outcome.stored.empty()) last_result_ = outcome.stored.back().id;
  if (!outcome.error) {
    ++scans_;
    store_trouble_.reset();
    return handle(StationEvent::kStored);
  }
  if (outcome.store_failed) return note_store_failure(*outcome.error);
  handle(outcome.error->code == ErrorCode::kCancelled ? StationEvent::kScanCancelled
                                                      : StationEvent::kScanFailed);
}

Error Station::refusal() const {
  if (machine_.is_leaving()) return stopping();
  const auto all = troubles(camera_status());
  // There is none while the look goes on by which the last one has just ended.
  if (state() == StationState::kStarting || all.empty()) {
    return {ErrorCode::kBusy, Remedy::kRetry, "the station is starting",
            "wait a moment and scan again"};
  }
  return all.front().error;
}

std::vector<StationTrouble> Station::troubles(const std::vector<CameraStatus>& cameras) const {
  std::vector<StationTrouble> all;
  const auto add = [&](const std::optional<Error>& trouble, const std::string& camera = {}) {
    if (trouble) all.push_back({*trouble, camera});
  };
  for (const auto& source : opening_troubles_) add(source.error, source.camera);
  for (const auto& camera : cameras) add(camera.trouble, camera.id);
  add(store_trouble_);
  add(pedal_trouble_);
  return all;
}

}  // namespace instep
