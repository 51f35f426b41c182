#pragma once

#include <mutex>

#include "daemon/store/storage.h"
#include "drivers/files/descriptor.h"

namespace instep {

/// The file system of this machine. Interrupted calls are repeated. Safe from many threads.
class PosixStorage : public Storage {
 public:
  Result<File> create_file(const std::filesystem::path& path) override;
  Result<std::size_t> write(File file, std::string_view bytes) override;
  Result<void> sync(File file) override;
  void close(File file) override;
  Result<void> make_folder(const std::filesystem::path& path) override;
  Result<void> rename(const std::filesystem::path& from, const std::filesystem::path& to) override;
  Result<void> remove_file(const std::filesystem::path& path) override;
  Result<void> remove_folder(const std::filesystem::path& path) override;
  Result<void> sync_folder(const std::filesystem::path& path) override;
  Result<void> check_writing(const std::filesystem::path& path) override;
  Result<bool> take_hold(const std::filesystem::path& path) override;
  void share_hold() override;
  Result<void> keep_hold(const std::filesystem::path& path) override;
  Result<std::vector<Entry>> list(const std::filesystem::path& path) override;
  Result<std::string> read(const std::filesystem::path& path, std::size_t most) override;

 private:
  std::mutex mutex_;  ///< of what follows
  Descriptor held_;
  bool was_held_ = false;  ///< once; by now the folder may be gone
  bool has_lock_ = false;  ///< that others see, alone or shared; or none can be had
};

/// file_error() of drivers/files/file_bytes.h, with the advice that fits the results' disk; `doing`
/// as in "write". `folder` is the one whose rights it is about.
Error storage_error(int error_number, const std::string& doing, const std::filesystem::path& path,
                    const std::filesystem::path& folder);

}  // namespace instep
