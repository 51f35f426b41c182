#include "daemon/service/station_service.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "daemon/control/store_requests.h"
#include "daemon/loop/caught.h"
#include "daemon/station/cause_of_trouble.h"
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
/// Mostly a scan is stored within a second.
constexpr std::chrono::seconds kLongStoring{30};

LastingThing lasting(const StationTrouble& trouble) {
  const std::string line = trouble.error.line();
  return {trouble.camera.empty() ? line : told_once("camera " + trouble.camera, trouble.error),
          line};
}

template <class Things, class ToLasting>
std::vector<LastingThing> all_lasting(const Things& things, const ToLasting& to_lasting) {
  std::vector<LastingThing> all;
  std::transform(things.begin(), things.end(), std::back_inserter(all), to_lasting);
  return all;
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
  store_care_.emplace(*loop_, *station_, store_, *archive_, settings_.store,
                      [this](const std::string& id) { forget_result(id); });

  storing_timer_ = loop_->timer([this] { storing_takes_long(); });
  watchdog_timer_ = loop_->timer([this] { feed_watchdog(); });
  shutdown_timer_ = loop_->timer([this] { loop_->leave(); });
  return loop_->on_signal(SIGTERM, [this] { shut_down(); })
      .and_then([&] { return loop_->on_signal(SIGINT, [this] { shut_down(); }); })
      .and_then([&] { return loop_->on_signal(SIGHUP, [this] { reload(); }); });
}

Result<bool> StationService::run() {
  store_care_->begin();
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

void StationService::storing_takes_long() {
  storing_takes_long_ = station_->state() == StationState::kStoring;
  station_changed();
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
  for (const auto& line : troubles_.news(all_lasting(now.troubles, lasting))) log_warning(line);
  if (was_in_trouble && troubles_.empty()) log_info("all is well again");
  const auto in_its_words = [](const std::string& line) { return LastingThing{line, line}; };
  for (const auto& line : warnings_.news(all_lasting(now.warnings, in_its_words))) {
    log_warning(line);
  }
  if (said_.is_news("stage", now.stage) && !now.stage.empty()) {
    log_debug("scan is at " + now.stage);
  }
  for (const auto& [name, on, trouble] : now.outputs) {
    if (!said_.is_news(name, trouble ? told_once(name, *trouble) : "")) continue;
    trouble ? log_warning(name + ": " + trouble->line()) : log_info(name + " is there again");
  }
  store_care_->station_changed();
  manager_.status(text_of(now));
  if (server_ && server_->has_watchers()) {
    server_->broadcast(event_line("status", to_json(now)));
  }
}

void StationService::scan_succeeded(const std::vector<StoredResult>& results) {
  for (const auto& result : results) log_info("stored scan " + result.id);
  last_result_event_ = event_line("result", to_json(results));
  last_result_time_ = EventLoop::monotonic_now();
  server_->broadcast(last_result_event_);
  store_care_->sweep();
}

void StationService::scan_failed(const Error& error) {
  log_warning("no scan: " + error.line());
  for (const auto& trouble : station_->status().troubles) {
    const auto [name, line] = lasting(trouble);
    if (line == error.line()) troubles_.add(name);
  }
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
    store_care_->set(settings->store);
    log_info(
        "read the settings again; cameras and their calibration, the pedal's kind and place, "
        "lamps, projector, "
        "simulation, store and socket change with a restart");
    store_care_->look();
    store_care_->sweep();
  }
  station_changed();
  manager_.ready(text_of(status()));
}

void StationService::shut_down() {
  if (std::exchange(leaving_, true)) return;
  store_care_->leave();
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
  const bool may_stall = store_care_->is_looking() || station_->state() == StationState::kStoring;
  progress_.note("archive", archive_->is_busy() && !may_stall, archive_->progress());
  if (progress_.all_moved()) manager_.feed_watchdog();
  if (const auto hung = progress_.newly_hung(); !hung.empty()) {
    log_warning(hung + " has made no step for a while");
  }
  watchdog_timer_.set(std::min(kWatchdogTick, limit / 4));
}

}  // namespace instep
