#include "daemon/station/output_keeper.h"

#include <utility>

#include "daemon/station/cause_of_trouble.h"

namespace instep {
namespace {

Result<void> write_to(std::unique_ptr<OutputLine>& line, const OutputKeeper::Open& open, bool on) {
  if (line && line->set(on)) return {};
  // Its board left, and may be back already.
  line.reset();
  auto opened = open();
  if (!opened) return tl::make_unexpected(opened.error());
  line = std::move(*opened);
  return line->set(on);
}

}  // namespace

Error silent_output() {
  return {ErrorCode::kTimeout, Remedy::kOperator, "it does not answer",
          "unplug its board and plug it in again"};
}

OutputKeeper::OutputKeeper(EventLoop& loop, const std::string& name, Open open,
                           std::function<void()> on_change, const Pace& pace)
    : loop_(loop),
      open_(std::move(open)),
      on_change_(std::move(on_change)),
      pace_(pace),
      line_(std::make_shared<std::unique_ptr<OutputLine>>()),
      thread_(name) {
  refresh_timer_ = loop_.timer([this] { write(); });
  patience_timer_ = loop_.timer([this] { note(silent_output()); });
  write();
}

OutputKeeper::~OutputKeeper() {
  finish();
}

bool OutputKeeper::finish() {
  put_off();
  return thread_.finish_by(*last_moment_);
}

void OutputKeeper::put_off() {
  if (last_moment_) return;
  last_moment_ = std::chrono::steady_clock::now() + kLastMoment;
  // The line's end puts it off, which may hang as any call of it.
  thread_.post([line = line_](TaskProgress&) { line->reset(); });
}

void OutputKeeper::set(bool on) {
  if (wanted_ == on) return;
  wanted_ = on;
  if (!writing_) write();
}

void OutputKeeper::write() {
  writing_ = true;
  refresh_timer_.clear();
  patience_timer_.set(pace_.patience);
  thread_.post(
      [this, line = line_, open = open_, on = wanted_, post = loop_.poster()](TaskProgress&) {
        const auto outcome = write_to(*line, open, on);
        const auto trouble = outcome ? std::nullopt : std::optional(outcome.error());
        post([this, on, trouble] { written(on, trouble); });
      });
}

void OutputKeeper::written(bool on, const std::optional<Error>& trouble) {
  writing_ = false;
  patience_timer_.clear();
  wanted_ == on ? refresh_timer_.set(pace_.refresh) : write();
  note(trouble);
}

void OutputKeeper::note(const std::optional<Error>& trouble) {
  const bool is_news = cause_of(trouble) != cause_of(trouble_);
  trouble_ = trouble;
  if (is_news) on_change_();
}

}  // namespace instep
