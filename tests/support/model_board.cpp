#include "tests/support/model_board.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>

namespace instep::test {

struct ModelBoard::State {
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::string, bool> levels;
  std::vector<std::string> changes;
  std::uint64_t plugged = 1;  ///< counts the times it was plugged in
  bool there = true;
  bool hangs = false;

  void change(const std::string& line, bool on) {
    bool& level = levels[line];
    if (level != on) changes.push_back(line + (on ? " on" : " off"));
    level = on;
    changed.notify_all();
  }
  std::unique_lock<std::mutex> reach() {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return !hangs; });
    return lock;
  }
};

class ModelBoard::Line final : public OutputLine {
 public:
  Line(std::shared_ptr<State> board, std::string name)
      : board_(std::move(board)), name_(std::move(name)), since_(board_->plugged) {}
  ~Line() override { [[maybe_unused]] const auto off = write(false); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  Result<void> set(bool on) override { return write(on); }

 private:
  Result<void> write(bool on) {
    const auto lock = board_->reach();
    if (!board_->there || since_ != board_->plugged) {
      return fail(ErrorCode::kDeviceGone, "the board left", "plug it in again");
    }
    board_->change(name_, on);
    return {};
  }

  std::shared_ptr<State> board_;
  std::string name_;
  std::uint64_t since_;
};

ModelBoard::ModelBoard() : state_(std::make_shared<State>()) {}

Result<std::unique_ptr<OutputLine>> ModelBoard::open(const std::string& line) {
  const auto lock = state_->reach();
  if (!state_->there) return fail(ErrorCode::kNotFound, "there is no board", "plug it in");
  state_->change(line, false);
  return std::make_unique<Line>(state_, line);
}

bool ModelBoard::is_on(const std::string& line) const {
  const std::lock_guard lock(state_->mutex);
  const auto found = state_->levels.find(line);
  return found != state_->levels.end() && found->second;
}

std::vector<std::string> ModelBoard::changes() const {
  const std::lock_guard lock(state_->mutex);
  return state_->changes;
}

bool ModelBoard::wait_for_changes(std::size_t count) const {
  std::unique_lock lock(state_->mutex);
  return state_->changed.wait_for(lock, std::chrono::seconds(10),
                                  [&] { return state_->changes.size() >= count; });
}

void ModelBoard::unplug() {
  const std::lock_guard lock(state_->mutex);
  state_->there = false;
  for (const auto& [line, on] : state_->levels) state_->change(line, false);
}

void ModelBoard::plug_in() {
  const std::lock_guard lock(state_->mutex);
  state_->there = true;
  ++state_->plugged;
}

void ModelBoard::hang() {
  const std::lock_guard lock(state_->mutex);
  state_->hangs = true;
}

void ModelBoard::let_go() {
  const std::lock_guard lock(state_->mutex);
  state_->hangs = false;
  state_->changed.notify_all();
}

}  // namespace instep::test
