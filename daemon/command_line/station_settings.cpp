#include "daemon/command_line/station_settings.h"

#include <optional>
#include <utility>

#include "config/settings_file.h"
#include "config/settings_search.h"
#include "daemon/build_facts.h"
#include "daemon/command_line/command_output.h"

namespace instep {
namespace {

using Loader = Result<Settings> (*)(const std::filesystem::path&);

Result<FoundSettings> found_by(Loader load) {
  const auto file = find_station_settings_file();
  if (!file) return tl::make_unexpected(file.error());
  auto settings = load(*file);
  if (!settings) return tl::make_unexpected(settings.error());
  override_paths(*settings, process_environment);
  return FoundSettings{*file, std::move(*settings)};
}

/// One that is named has to be there.
bool is_lack_of_a_file(const Error& error) {
  return error.code == ErrorCode::kNotFound && !process_environment("INSTEP_CONFIG");
}

}  // namespace

Result<std::filesystem::path> find_station_settings_file() {
  const SettingsPlaces places{std::nullopt, running_program_folder(), source_folder()};
  return find_settings(places, process_environment);
}

Result<FoundSettings> find_station_settings() {
  return found_by(load_settings);
}

Result<FoundSettings> find_uncalibrated_station_settings() {
  return found_by(load_uncalibrated_settings);
}

Result<MeasuringSettings> measuring_settings() {
  const bool is_named = process_environment("INSTEP_CONFIG").has_value();
  const auto file = find_station_settings_file();
  if (!file && is_named) return tl::make_unexpected(file.error());
  if (!file) return MeasuringSettings{};
  auto settings = load_measuring_settings(*file);
  if (settings || is_named) return settings;
  print_warning(
      "measures by the usual definitions and sizes, since those of the settings are "
      "unsound: " +
      settings.error().line() + ": instepd --check says all that is wrong");
  return MeasuringSettings{};
}

std::optional<Error> passed_over_settings() {
  const auto found = find_uncalibrated_station_settings();
  if (found || is_lack_of_a_file(found.error())) return std::nullopt;
  return found.error();
}

Settings station_settings() {
  if (auto found = find_uncalibrated_station_settings()) return std::move(found->settings);
  Settings settings;
  override_paths(settings, process_environment);
  return settings;
}

}  // namespace instep
