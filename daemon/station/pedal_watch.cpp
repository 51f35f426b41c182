#include "daemon/station/pedal_watch.h"

#include <sys/epoll.h>

#include <utility>

#include "daemon/loop/caught.h"
#include "daemon/station/cause_of_trouble.h"

namespace instep {

Error stuck_pedal() {
  return {ErrorCode::kBusy, Remedy::kOperator, "the pedal is held down or stuck",
          "take the foot off it; if it stays so, check its cable"};
}

Error chattering_pedal() {
  return {ErrorCode::kIo, Remedy::kOperator, "the pedal's contact opens and closes all the time",
          "check its plug and its cable, or try another pedal"};
}

Error silent_pedal() {
  return {ErrorCode::kTimeout, Remedy::kOperator, "the pedal does not answer",
          "unplug it, or the board that has its line, and plug it in again"};
}

PedalWatch::PedalWatch(EventLoop& loop, const PedalSettings& settings, Open open, Listener listener,
                       std::chrono::milliseconds patience)
    : loop_(loop),
      settings_(settings),
      open_(std::move(open)),
      listener_(std::move(listener)),
      patience_(patience),
      pedal_(std::make_shared<std::unique_ptr<Pedal>>()) {
  settle_timer_ = loop_.timer([this] { look(true); });
  reopen_timer_ = loop_.timer([this] { this->open(); });
  patience_timer_ = loop_.timer([this] { fell_silent(); });
  reopen_timer_.set(std::chrono::nanoseconds(0));
}

PedalWatch::~PedalWatch() {
  end_by(std::chrono::steady_clock::now() + kLastMoment);
}

void PedalWatch::put_off() {
  watch_ = {};
  // To close it may hang as any call of it.
  if (may_be_open_) thread_.post([pedal = pedal_](TaskProgress&) { pedal->reset(); });
  thread_.close();
}

bool PedalWatch::end_by(std::chrono::steady_clock::time_point deadline) {
  put_off();
  return thread_.finish_by(deadline);
}

void PedalWatch::set(const PedalSettings& settings) {
  settings_ = settings;
  if (!debouncer_) return;
  debouncer_->set_times(settings_.debounce, settings_.hold_to_cancel);
  pass_on();  // what waits for the old times is due at another one
}

void PedalWatch::open() {
  patience_timer_.set(patience_);
  may_be_open_ = true;
  thread_.post([this, pedal = pedal_, open = open_, afresh = std::exchange(is_silent_, false),
                post = loop_.poster()](TaskProgress&) {
    const auto opened = caught("the opening of the pedal", [&] {
      if (afresh) pedal->reset();
      return bring_up(*pedal, open);
    });
    post([this, opened] {
      patience_timer_.clear();
      is_silent_ = false;
      if (!opened) return lost(opened.error());
      may_be_open_ = opened->has_value();
      may_be_open_ ? begin(**opened) : returned();
    });
  });
}

/// Nothing if there is no pedal.
Result<std::optional<PedalWatch::Opened>> PedalWatch::bring_up(std::unique_ptr<Pedal>& pedal,
                                                               const Open& open) {
  if (!pedal) {
    auto opened = open();
    if (!opened) return tl::make_unexpected(opened.error());
    pedal = std::move(*opened);
    if (!pedal) return std::nullopt;
  } else if (const auto reopened = pedal->reopen(); !reopened) {
    return tl::make_unexpected(reopened.error());
  }
  const auto pressed = pedal->is_pressed();
  if (!pressed) return tl::make_unexpected(pressed.error());
  // One that hangs in reading alone is not to be told there, time and again. What came while it was
  // being opened starts no scan.
  const auto passed_over = pedal->read_edges();
  if (!passed_over) return tl::make_unexpected(passed_over.error());
  return Opened{pedal->descriptor(), passed_over->empty() ? *pressed : passed_over->back().pressed};
}

void PedalWatch::begin(const Opened& opened) {
  auto watching = loop_.watch(opened.descriptor, EPOLLIN, [this](std::uint32_t) { look(false); });
  if (!watching) return lost(watching.error());
  watch_ = std::move(*watching);
  debouncer_.emplace(settings_.debounce, settings_.hold_to_cancel, opened.pressed,
                     EventLoop::monotonic_now());
  returned();
  pass_on();
}

void PedalWatch::returned() {
  const bool was_there = std::exchange(is_known_, true) && !trouble_;
  trouble_.reset();
  if (!was_there) listener_.on_returned();
}

/// One at a time: what is due meanwhile is due still when that is over.
void PedalWatch::look(bool asks_level) {
  if (std::exchange(is_looking_, true)) return;
  watch_.set_events(0);
  patience_timer_.set(patience_);
  thread_.post([this, asks_level, pedal = pedal_, post = loop_.poster()](TaskProgress&) {
    const auto seen = caught("a look at the pedal", [&] { return look_at(**pedal, asks_level); });
    post([this, seen] { take(seen); });
  });
}

Result<PedalWatch::Seen> PedalWatch::look_at(Pedal& pedal, bool asks_level) {
  Seen seen;
  // Edges that wait are older than the level and come first.
  auto edges = pedal.read_edges();
  if (!edges) return tl::make_unexpected(edges.error());
  seen.edges = std::move(*edges);
  if (!asks_level) return seen;
  const auto pressed = pedal.is_pressed();
  if (!pressed) return tl::make_unexpected(pressed.error());
  seen.pressed = *pressed;
  seen.time = EventLoop::monotonic_now();
  return seen;
}

void PedalWatch::take(const Result<Seen>& seen) {
  is_looking_ = false;
  patience_timer_.clear();
  if (!seen) return lost(seen.error());
  // What it brought is of the time before it was told to be silent.
  if (is_silent_) return lost(silent_pedal());
  back_off_.reset();
  watch_.set_events(EPOLLIN);
  for (const auto& edge : seen->edges) debouncer_->on_edge(edge);
  if (seen->pressed) debouncer_->on_level(*seen->pressed, seen->time);
  pass_on();
}

void PedalWatch::pass_on() {
  for (const auto signal : debouncer_->take_signals()) listener_.on_signal(signal);
  if (const auto deadline = debouncer_->next_deadline()) {
    settle_timer_.set_at(*deadline);
  } else {
    settle_timer_.clear();
  }
}

void PedalWatch::fell_silent() {
  is_silent_ = true;
  tell(silent_pedal());
}

void PedalWatch::lost(const Error& error) {
  tell(error);
  reopen_timer_.set(back_off_.next());
}

/// Until it is opened again it is not listened to.
void PedalWatch::tell(const Error& error) {
  watch_ = {};
  settle_timer_.clear();
  debouncer_.reset();
  const bool is_news = cause_of(error) != cause_of(trouble_);
  trouble_ = error;
  is_known_ = true;
  if (is_news) listener_.on_lost(error);
}

}  // namespace instep
