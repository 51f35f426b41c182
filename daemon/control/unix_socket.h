#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>

#include "core/result.h"
#include "drivers/files/descriptor.h"
#include "drivers/files/file_identity.h"

namespace instep {

/// A Unix stream socket connected to `path`, close-on-exec. Fails with kNotFound if nobody listens
/// there, kTimeout if who does takes no connection within `limit` (above 0; nor may a later write
/// wait longer), kInvalidInput if something else is there, kPermissionDenied, or kIo.
Result<Descriptor> connect_unix_socket(const std::filesystem::path& path,
                                       std::chrono::microseconds limit = std::chrono::seconds(10));

/// What helps against a daemon that does not answer: to start one that runs does nothing.
inline constexpr const char* kIfItHangs =
    "see what it does: systemctl status instepd; where it hangs: sudo systemctl restart instepd";

/// Whether somebody listens on a socket that had this name and lost it: nobody can reach them.
/// Looks twice, 50 ms apart, where it seems so.
bool has_lost_listener(const std::filesystem::path& path);

/// One that listens, non-blocking, mode 0660, and is removed at its end if it is still the one that
/// has the name. A locked file beside it, PATH.lock, keeps two daemons that start at once from
/// taking it from each other.
class ListeningSocket {
 public:
  /// A socket that nobody listens on any more is replaced; fails with kBusy if somebody does, and
  /// with kPermissionDenied, kNotFound, kInvalidInput or kIo if it cannot be made.
  static Result<ListeningSocket> open(const std::filesystem::path& path);
  ~ListeningSocket();
  ListeningSocket(ListeningSocket&&) noexcept;
  ListeningSocket& operator=(ListeningSocket&&) = delete;

  int descriptor() const { return descriptor_.number(); }

 private:
  explicit ListeningSocket(std::filesystem::path path) : path_(std::move(path)) {}
  Result<void> lock();
  Result<void> make_way() const;
  Result<void> listen();

  std::filesystem::path path_;
  std::filesystem::path lock_path() const { return path_.string() + ".lock"; }
  Descriptor lock_;
  Descriptor descriptor_;
  std::optional<FileIdentity> socket_;
};

}  // namespace instep
