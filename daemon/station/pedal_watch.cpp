#include "daemon/station/pedal_watch.h"

#include <sys/epoll.h>

#include <utility>

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

PedalWatch::PedalWatch(EventLoop& loop, const PedalSettings& settings, Open open, Listener listener)
    : loop_(loop), settings_(settings), open_(std::move(open)), listener_(std::move(listener)) {
  settle_timer_ = loop_.timer([this] { settle(); });
  reopen_timer_ = loop_.timer([this] { this->open(); });
  reopen_timer_.set(std::chrono::nanoseconds(0));
}

void PedalWatch::set(const PedalSettings& settings) {
  settings_ = settings;
  if (!debouncer_) return;
  debouncer_->set_times(settings_.debounce, settings_.hold_to_cancel);
  pass_on();  // what waits for the old times is due at another one
}

void PedalWatch::open() {
  if (!pedal_) {
    auto opened = open_();
    if (!opened) return lost(opened.error());
    pedal_ = std::move(*opened);
    if (!pedal_) return;
  } else if (const auto reopened = pedal_->reopen(); !reopened) {
    return lost(reopened.error());
  }
  begin();
}

void PedalWatch::begin() {
  const auto pressed = pedal_->is_pressed();
  if (!pressed) return lost(pressed.error());
  auto watching = loop_.watch(pedal_->descriptor(), EPOLLIN, [this](std::uint32_t) { read(); });
  if (!watching) return lost(watching.error());
  watch_ = std::move(*watching);
  debouncer_.emplace(settings_.debounce, settings_.hold_to_cancel, *pressed,
                     EventLoop::monotonic_now());
  back_off_.reset();
  if (std::exchange(trouble_, std::nullopt)) listener_.on_returned();
  pass_on();
}

void PedalWatch::read() {
  const auto edges = pedal_->read_edges();
  if (!edges) return lost(edges.error());
  for (const auto& edge : *edges) debouncer_->on_edge(edge);
  pass_on();
}

void PedalWatch::settle() {
  if (!debouncer_) return;
  // Edges that wait are older than the level and come first.
  const auto edges = pedal_->read_edges();
  if (!edges) return lost(edges.error());
  for (const auto& edge : *edges) debouncer_->on_edge(edge);
  const auto pressed = pedal_->is_pressed();
  if (!pressed) return lost(pressed.error());
  debouncer_->on_level(*pressed, EventLoop::monotonic_now());
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

void PedalWatch::lost(const Error& error) {
  watch_ = {};
  settle_timer_.clear();
  debouncer_.reset();
  const bool is_news = cause_of(error) != cause_of(trouble_);
  trouble_ = error;
  if (is_news) listener_.on_lost(error);
  reopen_timer_.set(back_off_.next());
}

}  // namespace instep
