#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <optional>

namespace instep {

/// Which file it is, whatever its name.
struct FileIdentity {
  dev_t device = 0;
  ino_t inode = 0;
  friend bool operator==(const FileIdentity&, const FileIdentity&) = default;

  /// Of what has that name, a link itself; nothing if that cannot be told.
  static std::optional<FileIdentity> of(const std::filesystem::path& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) return std::nullopt;
    return FileIdentity{status.st_dev, status.st_ino};
  }
  static std::optional<FileIdentity> of(int descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return std::nullopt;
    return FileIdentity{status.st_dev, status.st_ino};
  }
};

/// Removes `path` if it still is the name of that file, and not of another that took its place.
inline void remove_if_same(const std::filesystem::path& path,
                           const std::optional<FileIdentity>& file) {
  if (file && FileIdentity::of(path) == file) ::unlink(path.c_str());
}

}  // namespace instep
