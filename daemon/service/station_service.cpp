#include "daemon/service/station_service.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "daemon/control/store_requests.h"
#include "daemon/loop/caught.h"
#include "daemon/store/posix_storage.h"

namespace instep {
namespace {

/// What SIGTERM promises.
constexpr std::chrono::milliseconds kPromisedEnd{1000};
/// A scan that is not over by then is left behind.
constexpr std::chrono::milliseconds kShutdownLimit{700};
/// What its threads have beyond that, all together.
constexpr std::chrono::milliseconds kThreadsLimit{150};
/// No limit is met to the millisecond.
constexpr std::chrono::milliseconds kToSpare{100};
static_assert(kShutdownLimit + std::max(kThreadsLimit, OutputKeeper::kLastMoment) + kToSpare <=
              kPromisedEnd);
constexpr std::chrono::microseconds kWatchdogTick{1000000};
/// Who asks for a result waits about so long for old ones to be removed, and for their list.
constexpr std::chrono::seconds kLongestSweep{1};
/// Between two looks whether the store is where it was, which cost next to nothing.
constexpr std::chrono::seconds kStoreLook{10};
/// A look at the store that makes no step for so long waits for its disk. Less than kStoreLook, so
/// that the next look tells of it.
constexpr std::chrono::seconds kStoreSilent{5};
/// Mostly a scan is stored within a second.
constexpr std::chrono::seconds kLongStoring{30};
/// Results grow old without a scan.
constexpr std::chrono::seconds kSweep{3600};
/// It may make room; and lists all results, so that it does not come with every look.
constexpr std::chrono::seconds kSweepInTrouble{60};

Error silent_store() {
  return {ErrorCode::kTimeout, Remedy::kOperator, "the disk of the results does not answer",
          "see to its cable or network, and if that does not help, restart the station"};
}

/// Of a store whose disk was taken away nobody can tell.
bool is_missing(ResultStore& store, const std::string& id) {
  if (!store.check_root()) return false;
  const auto found = store.find(id);
  return !found && found.error().code == ErrorCode::kNotFound;
}

}  // namespace

Result<std::unique_ptr<StationService>> StationService::create(Settings settings,
                                                               ReadSettings read_settings,
                                                               MeasureCapture measure) {
  std::unique_ptr<StationService> service(
      new StationService(std::move(settings), std::move(read_settings)));
  if (const auto opened = service->open(std::move(measure)); !opened) {
    return tl::make_unexpected(opened.error());
  }
  return service;
}

StationService::StationService(Settings settings, ReadSettings read_settings)
    : settings_(std::move(settings)), read_settings_(std::move(read_settings)) {}

StationService::~StationService() = default;

Result<void> StationService::open(MeasureCapture measure) {
  auto loop = EventLoop::create();
  if (!loop) return tl::make_unexpected(loop.error());
  loop_ = std::move(*loop);
  auto server = ControlServer::listen(
      *loop_, settings_.control.socket,
      [this](ControlServer::Client client, const Request& request) { serve(client, request); });
  if (!server) return tl::make_unexpected(server.error());
  server_ = std::move(*server);

  // Who asks where results are may do so from another folder.
  std::error_code failed;
  const auto root = std::filesystem::absolute(settings_.store.root, failed);
  store_ = std::make_shared<ResultStore>(std::make_shared<PosixStorage>(),
                                         failed ? settings_.store.root : root);
  archive_ = std::make_unique<TaskThread>("archive");
  StationListener listener;
  listener.on_change = [this] { station_changed(); };
  listener.on_result = [this](const auto& results) { scan_succeeded(results); };
  listener.on_failure = [this](const Error& error) { scan_failed(error); };
  listener.on_ignored_press = [this](std::uint64_t presses) {
    log_info(fmt::format("a press during a scan was ignored, the {}. so far", presses));
    server_->broadcast(event_line("ignored", {{"presses", presses}}));
  };
  listener.on_left = [this] { loop_->leave(); };
  station_ = std::make_unique<Station>(*loop_, settings_, std::move(measure), store_, listener);

  store_timer_ = loop_->timer([this] { look_at_store(); });
  storing_timer_ = loop_->timer([this] { storing_takes_long(); });
  sweep_timer_ = loop_->timer([this] { sweep_store(); });
  watchdog_timer_ = loop_->timer([this] { feed_watchdog(); });
  shutdown_timer_ = loop_->timer([this] { loop_->leave(); });
  return loop_->on_signal(SIGTERM, [this] { shut_down(); })
      .and_then([&] { return loop_->on_signal(SIGINT, [this] { shut_down(); }); })
      .and_then([&] { return loop_->on_signal(SIGHUP, [this] { reload(); }); });
}

Result<bool> StationService::run() {
  prepare_store();
  station_->begin();
  manager_.ready(text_of(status()));
  if (ServiceManager::watchdog_limit()) feed_watchdog();
  const auto ended = loop_->run();
  const bool all_ended = end_threads();
  server_.reset();
  if (!ended) return tl::make_unexpected(ended.error());
  return all_ended;
}

bool StationService::end_threads() {
  const auto deadline = std::chrono::steady_clock::now() + kThreadsLimit;
  auto left_behind = station_->end_by(deadline);
  if (!archive_->stop_by(deadline)) left_behind.emplace_back("the archive");
  if (left_behind.empty()) return true;
  log_warning(
      fmt::format("did not end in time and was abandoned: {}", fmt::join(left_behind, ", ")));
  return false;
}

void StationService::prepare_store() {
  store_timer_.set(kStoreLook);
  sweep_timer_.set(kSweep);
  archive_->post(
      [this, store = store_, looked = archive_looked_, post = loop_->poster()](TaskProgress&) {
        *looked = EventLoop::monotonic_now();
        const auto prepared = caught("the preparation of the store", [&] {
          return store->prepare([&] { *looked = EventLoop::monotonic_now(); });
        });
        *looked = std::chrono::nanoseconds(0);
        post([this, prepared] { store_prepared(prepared); });
      });
}

void StationService::store_prepared(const Result<Prepared>& prepared) {
  if (!prepared) return station_->store_failed(prepared.error());
  if (prepared->is_shared) {
    log_warning("another program works on the results in " + store_->root().string() +
                ": give each daemon its own store.root");
  }
  if (prepared->cleared > 0)
    log_info(fmt::format("cleared {} unfinished results", prepared->cleared));
  if (prepared->trouble) {
    log_warning("an unfinished result cannot be cleared: " + prepared->trouble->line());
  }
  sweep_store();
}

void StationService::look_at_store() {
  tell_of_silent_store();
  const auto trouble = station_->store_trouble();
  store_timer_.set(trouble ? store_trials_.next() : kStoreLook);
  if (is_looking_at_store_) return;
  is_looking_at_store_ = true;
  archive_->post([this, trouble, store = store_, looked = archive_looked_,
                  post = loop_->poster()](TaskProgress&) {
    *looked = EventLoop::monotonic_now();
    const auto outcome = caught("a look at the store",
                                [&] { return trouble ? store->try_out() : store->check_root(); });
    *looked = std::chrono::nanoseconds(0);
    post([this, trouble, outcome] {
      is_looking_at_store_ = false;
      if (trouble) return station_->store_tried_out(*trouble, outcome);
      if (!outcome) return station_->store_failed(outcome.error());
      // It took so long that trouble was told meanwhile, which may be over.
      if (station_->store_trouble()) look_at_store();
    });
  });
}

void StationService::tell_of_silent_store() {
  const std::chrono::nanoseconds looked = *archive_looked_;
  const bool is_silent = looked.count() != 0 && EventLoop::monotonic_now() - looked >= kStoreSilent;
  // To tell it again would make another trouble of it, which the look that waits does not end.
  if (is_silent && !station_->store_trouble()) station_->store_failed(silent_store());
}

void StationService::storing_takes_long() {
  storing_takes_long_ = station_->state() == StationState::kStoring;
  station_changed();
}

void StationService::sweep_store() {
  sweep_timer_.set(station_->store_trouble() ? kSweepInTrouble : kSweep);
  sweeps_again_ = is_sweeping_;
  if (is_sweeping_) return;
  is_sweeping_ = true;
  sweep_part(0);
}

void StationService::sweep_part(std::size_t removed_before) {
  Retention retention{settings_.store.keep_days, settings_.store.keep_count};
  if (retention.keep_days > 0 && clock_.was_set(ClockWatch::read())) {
    retention.keep_days = 0;
    if (said_.is_news("clock", "set")) {
      log_warning(
          "the clock was set by more than a week while the daemon runs: nothing is removed for its "
          "age until it is started again. What was scanned before counts from then on as old as "
          "its id says: see that the clock is right (timedatectl), and export what would be too "
          "old");
    }
  }
  archive_->post([this, retention, removed_before, last = station_->status().last_result,
                  store = store_, leaving = leaving_,
                  post = loop_->poster()](TaskProgress& progress) {
    std::optional<std::chrono::nanoseconds> end;  // told once they are listed, which takes long too
    const auto go_on = [&] {
      progress.step();
      const auto now = EventLoop::monotonic_now();
      if (!end) end = now + kLongestSweep;
      return !*leaving && now < *end;
    };
    const auto outcome = caught("the removal of old results", [&]() -> Result<Swept> {
      return store->sweep(retention, std::chrono::system_clock::now(), go_on,
                          [&] { progress.step(); });
    });
    Swept swept = outcome.value_or(Swept());
    if (!outcome) swept.trouble = outcome.error();
    const bool goes_on = swept.is_interrupted && swept.removed > 0;
    swept.removed += removed_before;
    const bool is_last_gone = !last.empty() && is_missing(*store, last);
    post([this, swept, goes_on, last, is_last_gone] {
      if (is_last_gone) forget_result(last);
      if (goes_on && !*leaving_) return sweep_part(swept.removed);
      tell_of(swept);
      is_sweeping_ = false;
      if (sweeps_again_ && !*leaving_) sweep_store();
    });
  });
}

void StationService::tell_of(const Swept& swept) {
  if (swept.removed > 0) log_info(fmt::format("removed {} old results", swept.removed));
  // The station tells it, and looks for its end.
  if (swept.root_trouble && !station_->store_trouble()) station_->store_failed(*swept.root_trouble);
  const std::string trouble = swept.trouble ? swept.trouble->line() : "";
  if (said_.is_news("sweep", trouble) && swept.trouble) {
    log_warning("an old result cannot be removed: " + trouble);
  }
  if (said_.is_news("later", std::to_string(swept.made_later)) && swept.made_later > 0) {
    log_warning(
        fmt::format("{} results are dated later than now: the clock was wrong when they were made, "
                    "or is (timedatectl); they are kept until their time has come",
                    swept.made_later));
  }
  if (said_.is_news("before all", std::to_string(swept.made_before_all)) &&
      swept.made_before_all > 0) {
    log_warning(fmt::format(
        "{} results are dated before there was this program: the clock was wrong when they were "
        "made. How old they are nobody can tell, so that they are kept until you delete them "
        "(instep list, instep delete)",
        swept.made_before_all));
  }
}

StationStatus StationService::status() const {
  auto status = station_->status();
  if (!settings_fault_.empty()) status.warnings.push_back(settings_fault_);
  // No trouble of the store, which would end the scan for the station while it can yet be stored.
  if (storing_takes_long_ && status.state == StationState::kStoring) {
    status.warnings.push_back("the scan is not stored yet, as " + silent_store().message +
                              ": see to its cable or network; the scan is kept until it does, and "
                              "a restart of the station would lose it");
  }
  return status;
}

std::string StationService::text_of(const StationStatus& now) const {
  std::string text = to_string(now.state);
  if (!now.stage.empty()) text += ": " + now.stage;
  if (!now.troubles.empty()) text += ": " + now.trouble();
  if (!settings_fault_.empty()) text += " (by the old settings: the new ones are faulty)";
  return text;
}

void StationService::station_changed() {
  if (!station_) return;
  const auto now = status();
  const std::string state = to_string(now.state);
  if (said_.is_news("state", state)) {
    log_info("station is " + state);
    storing_takes_long_ = false;
    if (now.state == StationState::kStoring) storing_timer_.set(kLongStoring);
  }
  const bool was_in_trouble = !troubles_.empty();
  for (const auto& trouble : troubles_.news(now.troubles)) log_warning(trouble);
  if (was_in_trouble && troubles_.empty()) log_info("all is well again");
  for (const auto& warning : warnings_.news(now.warnings)) log_warning(warning);
  if (said_.is_news("stage", now.stage) && !now.stage.empty()) {
    log_debug("scan is at " + now.stage);
  }
  for (const auto& [name, on, trouble] : now.outputs) {
    const std::string line = trouble ? trouble->line() : "";
    if (!said_.is_news(name, line)) continue;
    trouble ? log_warning(name + ": " + line) : log_info(name + " is there again");
  }
  const bool store_failed = station_->store_trouble().has_value();
  if (std::exchange(store_in_trouble_, store_failed) != store_failed) store_trouble_changed();
  manager_.status(text_of(now));
  if (server_ && server_->has_watchers()) {
    server_->broadcast(event_line("status", to_json(now)));
  }
}

void StationService::store_trouble_changed() {
  store_trials_.reset();
  store_timer_.set(store_in_trouble_ ? store_trials_.next() : kStoreLook);
  if (store_in_trouble_) sweep_timer_.set(kSweepInTrouble);
}

void StationService::scan_succeeded(const std::vector<StoredResult>& results) {
  for (const auto& result : results) log_info("stored scan " + result.id);
  last_result_event_ = event_line("result", to_json(results));
  last_result_time_ = EventLoop::monotonic_now();
  server_->broadcast(last_result_event_);
  sweep_store();
}

void StationService::scan_failed(const Error& error) {
  log_warning("no scan: " + error.line());
  const auto lasting = station_->status().troubles;
  const bool lasts = std::find(lasting.begin(), lasting.end(), error.line()) != lasting.end();
  if (lasts) troubles_.add(error.line());
  server_->broadcast(event_line("failure", {{"error", to_json(error)}}));
}

void StationService::serve(ControlServer::Client client, const Request& request) {
  const auto reply = [&](const Result<void>& outcome) {
    server_->answer(client, outcome ? ok_answer({}) : error_answer(outcome.error()));
  };
  if (request.verb == "scan") return reply(station_->request_scan());
  if (request.verb == "cancel") return reply(station_->request_cancel());
  if (request.verb == "watch") return begin_to_watch(client);
  if (request.verb == "status") {
    return server_->answer(client, ok_answer(to_json(status())));
  }
  serve_from_store(client, request);
}

void StationService::begin_to_watch(ControlServer::Client client) {
  if (const auto added = server_->add_watcher(client); !added) {
    return server_->answer(client, error_answer(added.error()));
  }
  server_->answer(client, ok_answer(to_json(status())));
  const bool recent = EventLoop::monotonic_now() - last_result_time_ < kRecentResult;
  if (recent && !last_result_event_.empty()) server_->send_event(client, last_result_event_);
}

void StationService::forget_result(const std::string& id) {
  if (last_result_event_.find(id) != std::string::npos) last_result_event_.clear();
  station_->forget_result(id);
}

void StationService::serve_from_store(ControlServer::Client client, const Request& request) {
  archive_->post(
      [this, client, request, store = store_, post = loop_->poster()](TaskProgress& progress) {
        const auto answer = caught("the answer", [&]() -> Result<std::string> {
          return answer_from_store(*store, request, [&] { progress.step(); });
        });
        const bool is_gone = request.verb == "delete" && is_missing(*store, request.id);
        post([this, client, id = request.id, is_gone,
              line = answer ? *answer : error_answer(answer.error())] {
          if (is_gone) forget_result(id);
          if (server_) server_->answer(client, line);
        });
      });
}

void StationService::reload() {
  manager_.reloading();
  const auto settings = read_settings_();
  settings_fault_ =
      settings ? ""
               : "the new settings are faulty, so that the old ones stay and the next start "
                 "will fail: " +
                     settings.error().line();
  if (!settings) {
    log_error(settings_fault_);
    warnings_.add(settings_fault_);
  } else {
    station_->reload(*settings);
    set_log_level(settings->log.level);
    settings_.store.keep_days = settings->store.keep_days;
    settings_.store.keep_count = settings->store.keep_count;
    log_info(
        "read the settings again; cameras and their calibration, the pedal's kind and place, "
        "lamps, projector, "
        "simulation, store and socket change with a restart");
    look_at_store();
    sweep_store();
  }
  station_changed();
  manager_.ready(text_of(status()));
}

void StationService::shut_down() {
  if (leaving_->exchange(true)) return;
  manager_.stopping();
  log_info("stopping");
  shutdown_timer_.set(kShutdownLimit);
  station_->shut_down();
}

void StationService::feed_watchdog() {
  const auto limit = ServiceManager::watchdog_limit().value_or(kWatchdogTick * 4);
  station_->note_progress(progress_);
  // An ailing disk is what it tries out, and to be started again mends none. Nor while a scan is
  // being stored, which shares the disk and would be lost.
  const bool may_stall =
      archive_looked_->load().count() != 0 || station_->state() == StationState::kStoring;
  progress_.note("archive", archive_->is_busy() && !may_stall, archive_->progress());
  if (progress_.all_moved()) manager_.feed_watchdog();
  if (const auto hung = progress_.newly_hung(); !hung.empty()) {
    log_warning(hung + " has made no step for a while");
  }
  watchdog_timer_.set(std::min(kWatchdogTick, limit / 4));
}

}  // namespace instep
