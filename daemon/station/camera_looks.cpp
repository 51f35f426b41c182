#include "daemon/station/camera_looks.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "daemon/station/camera_errors.h"

namespace instep {
namespace {

/// Of a call of start() (DepthCamera), and a little for the threads.
constexpr std::chrono::milliseconds kOpeningGrace{2500};

}  // namespace

CameraLooks::CameraLooks(EventLoop& loop, std::shared_ptr<CameraSet> cameras,
                         CaptureSettings settings, CameraSet::ZeroFrames zero_frames,
                         std::function<void()> on_end)
    : loop_(loop),
      cameras_(std::move(cameras)),
      settings_(std::move(settings)),
      zero_frames_(zero_frames),
      on_end_(std::move(on_end)),
      troubles_(cameras_->size()),
      unanswered_(cameras_->size(), false) {
  next_ = loop_.timer([this] { begin(); });
  deadline_ = loop_.timer([this] { end(); });
}

void CameraLooks::look() {
  back_off_.reset();
  if (is_paused_) {
    is_wanted_ = true;
  } else if (!is_under_way()) {
    begin();
  }
}

void CameraLooks::pause() {
  is_paused_ = true;
  is_wanted_ = is_under_way();
  next_.clear();
  close();
}

void CameraLooks::resume(bool at_once) {
  is_paused_ = false;
  next_.set(at_once || is_wanted_ ? std::chrono::nanoseconds(1) : settings_.check_every);
}

bool CameraLooks::all_answer() const {
  return std::none_of(troubles_.begin(), troubles_.end(), [](const auto& one) { return !!one; });
}

bool CameraLooks::is_under_way() const {
  return std::find(unanswered_.begin(), unanswered_.end(), true) != unanswered_.end();
}

void CameraLooks::begin() {
  const auto round = ++round_;
  unanswered_.assign(cameras_->size(), true);
  found_.assign(cameras_->size(), std::nullopt);
  next_.clear();
  deadline_.set(2 * settings_.frame_limit + kOpeningGrace);
  cameras_->check(settings_, zero_frames_,
                  [this, round, post = loop_.poster()](std::size_t camera, Result<void> outcome) {
                    post([this, round, camera, outcome = std::move(outcome)] {
                      answered(round, camera, outcome);
                    });
                  });
}

void CameraLooks::answered(std::uint64_t round, std::size_t camera, const Result<void>& outcome) {
  if (round != round_ || !unanswered_[camera]) return;
  unanswered_[camera] = false;
  found_[camera] = outcome ? std::nullopt : std::optional(outcome.error());
  if (!is_under_way()) end();
}

void CameraLooks::close() {
  ++round_;
  deadline_.clear();
  unanswered_.assign(unanswered_.size(), false);
}

void CameraLooks::end() {
  const auto told = cameras_->descriptions();
  for (std::size_t i = 0; i < unanswered_.size(); ++i) {
    if (unanswered_[i]) found_[i] = silent_camera(told[i].geometry.id);
  }
  troubles_ = found_;
  close();
  if (all_answer()) back_off_.reset();
  next_.set(all_answer() ? std::chrono::nanoseconds(settings_.check_every) : back_off_.next());
  on_end_();
}

}  // namespace instep
