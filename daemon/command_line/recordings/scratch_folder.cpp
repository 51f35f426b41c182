#include "daemon/command_line/recordings/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include "drivers/files/file_bytes.h"

namespace instep {

namespace fs = std::filesystem;

Result<ScratchFolder> ScratchFolder::make() {
  std::error_code failed;
  const fs::path temporary = fs::temp_directory_path(failed);
  if (failed) {
    return fail(ErrorCode::kNotFound, "there is no folder for temporary files: " + failed.message(),
                "let TMPDIR name one");
  }
  std::string path = (temporary / "instep-calibrate-XXXXXX").string();
  if (::mkdtemp(path.data()) == nullptr) {
    return tl::make_unexpected(file_error(errno, "make", path));
  }
  return ScratchFolder(path);
}

ScratchFolder::ScratchFolder(fs::path path) : path_(std::move(path)) {}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

ScratchFolder::ScratchFolder(ScratchFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})) {}

}  // namespace instep
