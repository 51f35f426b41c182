#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "drivers/pedal.h"

namespace instep::test {

/// A contact that rests open, whose edges a test makes up, behind a bus that may hang. Shared by
/// the pedal and the test.
class Contact {
 public:
  using Edges = std::vector<PedalEdge>;

  Contact() : ready_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
  ~Contact() { ::close(ready_); }
  Contact(const Contact&) = delete;
  Contact& operator=(const Contact&) = delete;

  int descriptor() const { return ready_; }
  void give(Edges edges) {
    const std::lock_guard lock(mutex_);
    edges_ = std::move(edges);
    ::eventfd_write(ready_, 1);
  }
  Edges take() {
    pass();
    std::unique_lock lock(mutex_);
    wait_until_free(lock, reading_hangs_);
    was_read_ = true;
    eventfd_t ignored = 0;
    ::eventfd_read(ready_, &ignored);
    return std::exchange(edges_, {});
  }

  void drop() {
    pass();
    const std::lock_guard lock(mutex_);
    edges_.clear();
  }

  /// From now on a call of the pedal does not return before let_go(), or for a minute.
  void hang() {
    const std::lock_guard lock(mutex_);
    hangs_ = true;
  }
  /// The same of those calls alone that read edges.
  void hang_in_reading() {
    const std::lock_guard lock(mutex_);
    reading_hangs_ = true;
  }
  void let_go() {
    const std::lock_guard lock(mutex_);
    hangs_ = reading_hangs_ = false;
    changed_.notify_all();
  }
  /// The way over the bus, which every call takes.
  void pass() {
    std::unique_lock lock(mutex_);
    wait_until_free(lock, hangs_);
  }
  /// Which ends its opening.
  bool was_read() {
    const std::lock_guard lock(mutex_);
    return was_read_;
  }
  bool holds_a_call() {
    const std::lock_guard lock(mutex_);
    return (hangs_ || reading_hangs_) && in_call_ > 0;
  }

  void note_closed() {
    const std::lock_guard lock(mutex_);
    ++closed_;
    changed_.notify_all();
  }
  bool wait_until_closed(int times) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(10), [&] { return closed_ >= times; });
  }

 private:
  void wait_until_free(std::unique_lock<std::mutex>& lock, const bool& hangs) {
    ++in_call_;
    changed_.notify_all();
    changed_.wait_for(lock, std::chrono::minutes(1), [&] { return !hangs; });
    --in_call_;
  }

  int ready_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Edges edges_;
  bool hangs_ = false;
  bool reading_hangs_ = false;
  bool was_read_ = false;
  int in_call_ = 0;
  int closed_ = 0;
};

class ContactPedal final : public Pedal {
 public:
  explicit ContactPedal(std::shared_ptr<Contact> contact) : contact_(std::move(contact)) {
    contact_->drop();  // what came before is none of this one's
  }
  ~ContactPedal() override {
    contact_->pass();
    contact_->note_closed();
  }
  int descriptor() const override { return contact_->descriptor(); }
  Result<std::vector<PedalEdge>> read_edges() override { return contact_->take(); }
  Result<bool> is_pressed() override {
    contact_->pass();
    return false;
  }
  Result<void> reopen() override {
    contact_->pass();
    return {};
  }

 private:
  std::shared_ptr<Contact> contact_;
};

}  // namespace instep::test
