#include "daemon/store/store_root.h"

#include <fmt/format.h>

#include <chrono>
#include <random>
#include <thread>
#include <utility>

#include "daemon/store/storage_steps.h"

namespace instep {
namespace {

constexpr const char* kMark = "store-id";
constexpr std::size_t kLongestMark = 1024;
/// Another program that begins clears what was left half-done, which is little.
constexpr std::chrono::seconds kLongestWait{2};
constexpr std::chrono::milliseconds kBetweenLooks{20};

std::string new_mark() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}\n", random(), random(), random(), random());
}

}  // namespace

StoreRoot::StoreRoot(std::shared_ptr<Storage> storage, std::filesystem::path path)
    : storage_(std::move(storage)), path_(std::move(path)) {}

Result<bool> StoreRoot::take() {
  // Else the first result would be measured in vain.
  auto is_ours = storage_->make_folder(path_)
                     .and_then([&] { return storage_->check_writing(path_); })
                     .and_then([&] { return storage_->take_hold(path_); });
  is_taken_ = is_ours.has_value();
  return is_ours;
}

void StoreRoot::share() {
  storage_->share_hold();
}

void StoreRoot::mark() {
  const std::lock_guard lock(mutex_);
  if (!mark_.empty()) return;
  const auto file = path_ / kMark;
  auto there = storage_->read(file, kLongestMark);
  // A power cut may have left an empty one.
  if (there && there->empty()) (void)storage_->remove_file(file);
  if (!there || there->empty()) {
    (void)write_file(*storage_, file, new_mark()).and_then([&] {
      return storage_->sync_folder(path_);
    });
    // Another program may have been first.
    there = storage_->read(file, kLongestMark);
  }
  if (there) mark_ = *there;
}

Result<void> StoreRoot::check() {
  const auto deadline = std::chrono::steady_clock::now() + kLongestWait;
  while (true) {
    auto outcome = look();
    const bool may_change = !outcome && outcome.error().code == ErrorCode::kBusy;
    if (!may_change || std::chrono::steady_clock::now() >= deadline) return outcome;
    std::this_thread::sleep_for(kBetweenLooks);
  }
}

Result<void> StoreRoot::look() {
  const std::lock_guard lock(mutex_);
  auto held = storage_->keep_hold(path_);
  if (held || held.error().code != ErrorCode::kDeviceGone || mark_.empty()) return held;
  const auto mark = storage_->read(path_ / kMark, kLongestMark);
  if (!mark || *mark != mark_) return held;
  if (const auto taken = storage_->take_hold(path_); !taken) {
    return tl::make_unexpected(taken.error());
  }
  storage_->share_hold();
  return storage_->keep_hold(path_);
}

}  // namespace instep
