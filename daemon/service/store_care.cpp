#include "daemon/service/store_care.h"

#include <fmt/format.h>

#include <utility>

#include "daemon/loop/caught.h"

namespace instep {
namespace {

/// Who asks for a result waits about so long for old ones to be removed, and for their list.
constexpr std::chrono::seconds kLongestSweep{1};
/// Between two looks whether the store is where it was, which cost next to nothing.
constexpr std::chrono::seconds kStoreLook{10};
/// A look at the store that makes no step for so long waits for its disk. Less than kStoreLook, so
/// that the next look tells of it.
constexpr std::chrono::seconds kStoreSilent{5};
/// Results grow old without a scan.
constexpr std::chrono::seconds kSweep{3600};
/// It may make room; and lists all results, so that it does not come with every look.
constexpr std::chrono::seconds kSweepInTrouble{60};

}  // namespace

Error silent_store() {
  return {ErrorCode::kTimeout, Remedy::kOperator, "the disk of the results does not answer",
          "see to its cable or network, and if that does not help, restart the station"};
}

bool is_missing(ResultStore& store, const std::string& id) {
  if (!store.check_root()) return false;
  const auto found = store.find(id);
  return !found && found.error().code == ErrorCode::kNotFound;
}

StoreCare::StoreCare(EventLoop& loop, Station& station, std::shared_ptr<ResultStore> store,
                     TaskThread& archive, const StoreSettings& settings, OnRemoved last_removed)
    : loop_(loop),
      station_(station),
      store_(std::move(store)),
      archive_(archive),
      settings_(settings),
      last_removed_(std::move(last_removed)) {
  look_timer_ = loop_.timer([this] { look(); });
  sweep_timer_ = loop_.timer([this] { sweep(); });
}

void StoreCare::begin() {
  look_timer_.set(kStoreLook);
  sweep_timer_.set(kSweep);
  archive_.post([this, store = store_, looked = looked_, post = loop_.poster()](TaskProgress&) {
    *looked = EventLoop::monotonic_now();
    const auto prepared = caught("the preparation of the store", [&] {
      return store->prepare([&] { *looked = EventLoop::monotonic_now(); });
    });
    *looked = std::chrono::nanoseconds(0);
    post([this, prepared] { was_prepared(prepared); });
  });
}

void StoreCare::was_prepared(const Result<Prepared>& prepared) {
  if (!prepared) return station_.store_failed(prepared.error());
  if (prepared->is_shared) {
    log_warning("another program works on the results in " + store_->root().string() +
                ": give each daemon its own store.root");
  }
  if (prepared->cleared > 0)
    log_info(fmt::format("cleared {} unfinished results", prepared->cleared));
  if (prepared->trouble) {
    log_warning("an unfinished result cannot be cleared: " + prepared->trouble->line());
  }
  sweep();
}

void StoreCare::look() {
  tell_of_silent_store();
  const auto trouble = station_.store_trouble();
  look_timer_.set(trouble ? trials_.next() : kStoreLook);
  if (is_looking_) return;
  is_looking_ = true;
  archive_.post([this, trouble, store = store_, looked = looked_,
                 post = loop_.poster()](TaskProgress&) {
    *looked = EventLoop::monotonic_now();
    const auto outcome = caught("a look at the store",
                                [&] { return trouble ? store->try_out() : store->check_root(); });
    *looked = std::chrono::nanoseconds(0);
    post([this, trouble, outcome] {
      is_looking_ = false;
      if (trouble) return station_.store_tried_out(*trouble, outcome);
      if (!outcome) return station_.store_failed(outcome.error());
      // It took so long that trouble was told meanwhile, which may be over.
      if (station_.store_trouble()) look();
    });
  });
}

void StoreCare::tell_of_silent_store() {
  const std::chrono::nanoseconds looked = *looked_;
  const bool is_silent = looked.count() != 0 && EventLoop::monotonic_now() - looked >= kStoreSilent;
  // To tell it again would make another trouble of it, which the look that waits does not end.
  if (is_silent && !station_.store_trouble()) station_.store_failed(silent_store());
}

void StoreCare::sweep() {
  sweep_timer_.set(station_.store_trouble() ? kSweepInTrouble : kSweep);
  sweeps_again_ = is_sweeping_;
  if (is_sweeping_) return;
  is_sweeping_ = true;
  sweep_part(0);
}

void StoreCare::sweep_part(std::size_t removed_before) {
  Retention retention{settings_.keep_days, settings_.keep_count};
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
  archive_.post([this, retention, removed_before, last = station_.status().last_result,
                 store = store_, leaving = leaving_,
                 post = loop_.poster()](TaskProgress& progress) {
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
      if (is_last_gone) last_removed_(last);
      if (goes_on && !*leaving_) return sweep_part(swept.removed);
      tell_of(swept);
      is_sweeping_ = false;
      if (sweeps_again_ && !*leaving_) sweep();
    });
  });
}

void StoreCare::tell_of(const Swept& swept) {
  if (swept.removed > 0) log_info(fmt::format("removed {} old results", swept.removed));
  // The station tells it, and looks for its end.
  if (swept.root_trouble && !station_.store_trouble()) station_.store_failed(*swept.root_trouble);
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

void StoreCare::station_changed() {
  const bool in_trouble = station_.store_trouble().has_value();
  if (std::exchange(in_trouble_, in_trouble) == in_trouble) return;
  trials_.reset();
  look_timer_.set(in_trouble_ ? trials_.next() : kStoreLook);
  if (in_trouble_) sweep_timer_.set(kSweepInTrouble);
}

}  // namespace instep
