#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "core/result.h"
#include "daemon/store/storage.h"

namespace instep {

/// The folder of all results, which may be taken away with its disk while it is in use, come back,
/// or have another in its place. It holds a mark that no other store has, `store-id`, by which it
/// is known again, though the system counts a disk that was plugged in again as another. Safe from
/// many threads.
class StoreRoot {
 public:
  StoreRoot(std::shared_ptr<Storage> storage, std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }

  /// Makes it (its parent must be there), sees that it can be written in, and takes hold of it.
  /// False if another program has it; else alone until share(). May be done again.
  Result<bool> take();
  bool is_taken() const { return is_taken_; }
  /// Lets other programs take hold of it too.
  void share();

  /// Marks it unless it is marked, and remembers its mark. Where that fails, as on a full disk, it
  /// is only not known again.
  void mark();

  /// Whether the folder under its name is the one that take() took hold of; by its mark it is taken
  /// hold of again. Fails with kNotFound if it is gone, with kDeviceGone if another has its place,
  /// and with kBusy if another program clears it for longer than this waits. Mostly cheap.
  Result<void> check();

 private:
  Result<void> look();

  std::shared_ptr<Storage> storage_;
  std::filesystem::path path_;
  std::atomic<bool> is_taken_ = false;
  std::mutex mutex_;  ///< of what follows, and of a look
  std::string mark_;
};

}  // namespace instep
