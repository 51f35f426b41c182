#include "config/settings_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::HasSubstr;

std::optional<std::string> nothing(const char*) {
  return std::nullopt;
}

Result<std::filesystem::path> asked_for(const std::filesystem::path& file) {
  return find_settings({file, "/none", "/none"}, nothing);
}

// The daemon's results were looked for in the folder of whoever asked.
TEST(SettingsSearch, TakesPathsOfTheEnvironmentFromTheWorkingFolder) {
  Settings settings;
  const auto before = settings.control.socket;
  override_paths(settings, [](const char* name) -> std::optional<std::string> {
    if (std::string(name) == "INSTEP_STORE") return "scans";
    if (std::string(name) == "INSTEP_PEDAL") return "/run/pedal";
    return std::nullopt;
  });
  EXPECT_EQ(settings.store.root, std::filesystem::current_path() / "scans");
  EXPECT_EQ(settings.pedal.fifo, "/run/pedal");
  EXPECT_EQ(settings.control.socket, before);
}

TEST(SettingsSearch, SaysWhatIsThereInsteadOfAFile) {
  const test::TemporaryFolder folder;
  const auto folder_asked = asked_for(folder.path());
  ASSERT_FALSE(folder_asked);
  EXPECT_EQ(folder_asked.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(folder_asked.error().line(), HasSubstr("is a folder and no settings file"));

  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(asked_for(pipe).error().line(), HasSubstr("is a pipe and no settings file"));
  EXPECT_THAT(asked_for("/dev/null").error().line(), HasSubstr("is a device"));

  const auto missing = asked_for(folder.path() / "missing.toml");
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace instep
