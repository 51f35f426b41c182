#include "config/reading/settings_text.h"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace instep {

Result<std::string> read_settings_text(const std::filesystem::path& file, const std::string& what) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    const auto code = errno == EACCES ? ErrorCode::kPermissionDenied : ErrorCode::kIo;
    return fail(code,
                "the " + what + " " + file.string() + " cannot be opened: " + std::strerror(errno),
                "let the user of the station read it");
  }
  std::string text(kLargestSettingsFile + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  // What came before the failure may look like a whole file.
  if (stream.bad()) {
    return fail(ErrorCode::kIo, "the " + what + " " + file.string() + " cannot be read to its end",
                "check that it is a file, and its disk");
  }
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() <= kLargestSettingsFile) return text;
  return fail(ErrorCode::kInvalidInput, "the " + what + " " + file.string() + " is far too long",
              "check that it is a " + what);
}

}  // namespace instep
