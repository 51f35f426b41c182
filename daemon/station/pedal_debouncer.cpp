#include "daemon/station/pedal_debouncer.h"

#include <algorithm>
#include <utility>

namespace instep {

PedalDebouncer::PedalDebouncer(Time debounce, Time hold, bool pressed_at_start, Time now)
    : debounce_(debounce), hold_(hold), now_(now), raw_(pressed_at_start), raw_since_(now) {
  if (!pressed_at_start) return;
  pressed_ = true;
  pressed_since_ = now;
  held_ = true;
  stuck_ = true;
  signals_.push_back(PedalSignal::kStuck);
}

void PedalDebouncer::set_times(Time debounce, Time hold) {
  debounce_ = debounce;
  hold_ = hold;
}

void PedalDebouncer::on_edge(const PedalEdge& edge) {
  advance(edge.time);
  raw_ = edge.pressed;
  raw_since_ = now_;
  if (!restless_since_) restless_since_ = now_;
  if (!chattering_ && *restless_since_ + kChatteringAfter <= now_) {
    chattering_ = true;
    signals_.push_back(PedalSignal::kChattering);
  }
}

void PedalDebouncer::on_level(bool pressed, Time now) {
  if (pressed != raw_) {
    // An edge was lost; when it came is not known, so the contact has to prove itself from now on,
    // unless it proves to be as believed all along.
    const bool quiet = raw_since_ + debounce_ <= now;
    raw_ = pressed;
    raw_since_ = std::max(now, now_);
    if (!restless_since_) restless_since_ = raw_since_;
    if (quiet && raw_ == pressed_ && !chattering_) restless_since_.reset();
  }
  advance(now);
}

void PedalDebouncer::advance(Time now) {
  now_ = std::max(now, now_);
  if (pressed_ && !held_ && pressed_since_ + hold_ <= (raw_ ? now_ : raw_since_)) {
    held_ = true;
    signals_.push_back(PedalSignal::kHeld);
  }
  if (restless_since_ && raw_since_ + debounce_ <= now_) come_to_rest();
  if (pressed_ && !stuck_ && pressed_since_ + kStuckAfter <= now_) {
    stuck_ = true;
    signals_.push_back(PedalSignal::kStuck);
  }
}

void PedalDebouncer::come_to_rest() {
  restless_since_.reset();
  const bool trusted = !std::exchange(chattering_, false);
  if (trusted && raw_ == pressed_) return;
  change(raw_, raw_since_);
  if (trusted || !pressed_) return;
  signals_.back() = PedalSignal::kStuck;
  held_ = true;
  stuck_ = true;
}

void PedalDebouncer::change(bool pressed, Time since) {
  pressed_ = pressed;
  pressed_since_ = since;
  held_ = false;
  stuck_ = false;
  signals_.push_back(pressed ? PedalSignal::kPressed : PedalSignal::kReleased);
}

std::optional<PedalDebouncer::Time> PedalDebouncer::next_deadline() const {
  std::optional<Time> next;
  const auto consider = [&](Time time) { next = next ? std::min(*next, time) : time; };
  if (restless_since_)
    consider(raw_since_ + debounce_);
  else if (pressed_ && !held_)
    consider(pressed_since_ + hold_);
  else if (pressed_ && !stuck_)
    consider(pressed_since_ + kStuckAfter);
  return next;
}

std::vector<PedalSignal> PedalDebouncer::take_signals() {
  return std::exchange(signals_, {});
}

}  // namespace instep
