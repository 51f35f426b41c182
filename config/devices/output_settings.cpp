#include "config/devices/output_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/reading/settings_table.h"

namespace instep {
namespace {

/// A line that a table names.
struct Claim {
  std::string table;
  const GpioPlace* place = nullptr;
  unsigned line = 0;  ///< of the table in the file; the first claim's is never blamed
};

void read_output(SettingsTable& parent, const std::string& key,
                 std::optional<GpioOutputSettings>& output, std::vector<Claim>& claims,
                 SettingsFaults& faults) {
  const toml::table* found = parent.table(key);
  if (found == nullptr) return;
  SettingsTable table(*found, parent.full(key), faults);
  output.emplace();
  read_gpio_place(table, output->place);
  require_gpio_place(table, faults);
  table.choose("active", output->active_low, {{"low", true}, {"high", false}});
  table.finish();
  claims.push_back({table.name(), &output->place, table.line()});
}

void check_lines_differ(const std::vector<Claim>& claims, SettingsFaults& faults) {
  for (auto claim = claims.begin(); claim != claims.end(); ++claim) {
    const auto rival = std::find_if(claims.begin(), claim, [&](const Claim& one) {
      return one.place->is_same_line(*claim->place);
    });
    if (rival == claim) continue;
    faults.add(claim->line,
               fmt::format("{} names the same line as {}", claim->table, rival->table));
  }
}

}  // namespace

std::vector<OutputSettings::Named> OutputSettings::named() const {
  std::vector<Named> all;
  const auto add = [&](const char* name, const std::optional<GpioOutputSettings>& output) {
    if (output) all.push_back({name, &*output});
  };
  add("lamp.ready", ready_lamp);
  add("lamp.busy", busy_lamp);
  add("lamp.fault", fault_lamp);
  add("projector", projector);
  return all;
}

void read_outputs(SettingsTable& root, OutputSettings& outputs, const GpioPlace* pedal,
                  SettingsFaults& faults) {
  const auto faults_before = faults.count();
  std::vector<Claim> claims;
  if (pedal != nullptr) claims.push_back({"pedal.gpio", pedal});
  if (const toml::table* found = root.table("lamp")) {
    SettingsTable lamp(*found, "lamp", faults);
    read_output(lamp, "ready", outputs.ready_lamp, claims, faults);
    read_output(lamp, "busy", outputs.busy_lamp, claims, faults);
    read_output(lamp, "fault", outputs.fault_lamp, claims, faults);
    lamp.finish();
  }
  read_output(root, "projector", outputs.projector, claims, faults);
  // One with a fault may look like another only because of it.
  if (faults.count() == faults_before) check_lines_differ(claims, faults);
}

std::string describe(const GpioOutputSettings& output) {
  return fmt::format("{}, active {}", describe(output.place), output.active_low ? "low" : "high");
}

}  // namespace instep
