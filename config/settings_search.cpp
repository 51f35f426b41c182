#include "config/settings_search.h"

#include <cstdlib>
#include <system_error>

namespace instep {
namespace {

const char* kind_of(const std::filesystem::file_status& status) {
  switch (status.type()) {
    case std::filesystem::file_type::directory:
      return "a folder";
    case std::filesystem::file_type::fifo:
      return "a pipe";
    case std::filesystem::file_type::socket:
      return "a socket";
    default:
      return "a device";
  }
}

}  // namespace

std::vector<std::filesystem::path> settings_candidates(const SettingsPlaces& places,
                                                       const Environment& environment) {
  if (places.asked) return {*places.asked};
  if (const auto named = environment("INSTEP_CONFIG")) return {*named};
  const auto prefix = places.binary_folder.parent_path();
  return {"/etc/instep/instep.toml", prefix / "etc/instep/instep.toml",
          prefix / "share/instep/instep.toml", places.source_folder / "config/instep.toml"};
}

Result<std::filesystem::path> find_settings(const SettingsPlaces& places,
                                            const Environment& environment) {
  std::string tried;
  for (const auto& candidate : settings_candidates(places, environment)) {
    std::error_code failed;
    const auto status = std::filesystem::status(candidate, failed);
    if (std::filesystem::is_regular_file(status)) return candidate;
    if (std::filesystem::exists(status)) {
      return fail(ErrorCode::kInvalidInput,
                  candidate.string() + " is " + kind_of(status) + " and no settings file",
                  "name the file itself");
    }
    if (failed == std::errc::permission_denied) {
      return fail(ErrorCode::kPermissionDenied,
                  "you may not look whether " + candidate.string() + " is there",
                  "change its folder's permissions or run as a user who may");
    }
    tried += (tried.empty() ? "" : ", ") + candidate.string();
  }
  return fail(ErrorCode::kNotFound, "there is no settings file at " + tried,
              "name one with --config where a command has it, or in INSTEP_CONFIG");
}

void override_paths(Settings& settings, const Environment& environment) {
  const auto put_over = [&](const char* name, std::filesystem::path& path) {
    const auto named = environment(name);
    if (!named) return;
    // Who asks the daemon may do so from another folder.
    std::error_code failed;
    path = std::filesystem::absolute(*named, failed);
    if (failed) path = *named;
  };
  put_over("INSTEP_STORE", settings.store.root);
  put_over("INSTEP_SOCKET", settings.control.socket);
  put_over("INSTEP_PEDAL", settings.pedal.fifo);
}

std::optional<std::string> process_environment(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr || *value == '\0') return std::nullopt;
  return value;
}

std::filesystem::path running_program_folder() {
  std::error_code failed;
  return std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
}

}  // namespace instep
