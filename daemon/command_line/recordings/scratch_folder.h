#pragma once

#include <filesystem>

#include "core/result.h"

namespace instep {

/// A folder of its own among the temporary files, gone with all in it at the end of the scope.
class ScratchFolder {
 public:
  /// Fails with what the operating system says.
  static Result<ScratchFolder> make();
  ~ScratchFolder();
  ScratchFolder(ScratchFolder&& other) noexcept;
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  explicit ScratchFolder(std::filesystem::path path);

  std::filesystem::path path_;
};

}  // namespace instep
