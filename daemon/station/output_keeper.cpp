#include "daemon/station/output_keeper.h"

#include <utility>

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

/// Looked for again and again, what is away is missed in other words: "none of 2 chips".
std::optional<ErrorCode> cause_of(const std::optional<Error>& trouble) {
  if (!trouble) return std::nullopt;
  return trouble->code == ErrorCode::kDeviceGone ? ErrorCode::kNotFound : trouble->code;
}

}  // namespace

OutputKeeper::OutputKeeper(EventLoop& loop, Open open, std::function<void()> on_change,
                           std::chrono::milliseconds refresh)
    : loop_(loop),
      open_(std::move(open)),
      on_change_(std::move(on_change)),
      refresh_(refresh),
      line_(std::make_shared<std::unique_ptr<OutputLine>>()) {
  refresh_timer_ = loop_.timer([this] { write(); });
  write();
}

OutputKeeper::~OutputKeeper() {
  // With the last task that holds it the line goes, which puts it off.
  thread_.stop(kLastMoment);
}

void OutputKeeper::set(bool on) {
  if (wanted_ == on) return;
  wanted_ = on;
  if (!writing_) write();
}

void OutputKeeper::write() {
  writing_ = true;
  refresh_timer_.clear();
  thread_.post(
      [this, line = line_, open = open_, on = wanted_, post = loop_.poster()](TaskProgress&) {
        const auto outcome = write_to(*line, open, on);
        const auto trouble = outcome ? std::nullopt : std::optional(outcome.error());
        post([this, on, trouble] { written(on, trouble); });
      });
}

void OutputKeeper::written(bool on, const std::optional<Error>& trouble) {
  writing_ = false;
  wanted_ == on ? refresh_timer_.set(refresh_) : write();
  if (cause_of(trouble) == cause_of(trouble_)) return;
  trouble_ = trouble;
  on_change_();
}

}  // namespace instep
