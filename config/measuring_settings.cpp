#include "config/measuring_settings.h"

#include <fmt/format.h>

#include <string>

#include "config/reading/settings_text.h"
#include "config/reading/toml_reading.h"
#include "config/settings.h"

namespace instep {
namespace {

/// The other tables of the settings.
constexpr const char* kOfTheStation[] = {"station",    "capture", "pedal",   "lamp", "projector",
                                         "simulation", "store",   "control", "log",  "camera"};

template <typename Rule, std::size_t Count>
void choose_rule(SettingsTable& table, const std::string& key, Rule& rule,
                 const RuleNames<Rule, Count>& names) {
  table.choose(key, rule, SettingsTable::Choices<Rule>(names.begin(), names.end()));
}

void read_measures(SettingsTable& table, MeasuringRules& rules) {
  choose_rule(table, "axis", rules.axis, kAxisRules);
  choose_rule(table, "ball_girth", rules.ball_girth, kBallGirthRules);
  choose_rule(table, "instep_girth", rules.instep_girth, kInstepGirthRules);
  choose_rule(table, "heel_breadth", rules.heel_breadth, kHeelBreadthRules);
}

ShopSize read_shop_size(SettingsTable& table) {
  ShopSize row;
  table.read("size", row.size, 32);
  table.read("longest_foot_mm", row.longest_foot_mm, 80, 400);
  table.read("largest_ball_girth_mm", row.largest_ball_girth_mm, 80, 500);
  table.finish();
  return row;
}

/// A row that names no size or no length is a fault, and so is one shorter than the row before.
void check_shop_size(const ShopSize& row, const std::vector<ShopSize>& before, unsigned line,
                     SettingsFaults& faults) {
  if (row.size.empty()) faults.add(line, "sizes.shop.sizes.size is missing: what is on the box?");
  if (row.longest_foot_mm == 0.0) {
    faults.add(line, "sizes.shop.sizes.longest_foot_mm is missing: how long a foot goes in?");
  } else if (!before.empty() && row.longest_foot_mm < before.back().longest_foot_mm) {
    faults.add(line, "sizes.shop.sizes must stand in the order of longest_foot_mm");
  }
}

ShopTable read_shop_table(SettingsTable& table, SettingsFaults& faults) {
  ShopTable shop;
  table.read("name", shop.name, 64);
  if (shop.name.empty()) faults.add(table.line(), "sizes.shop.name is missing");
  for (const toml::table* size : table.tables("sizes")) {
    SettingsTable row(*size, "sizes.shop.sizes", faults);
    const ShopSize found = read_shop_size(row);
    check_shop_size(found, shop.sizes, row.line(), faults);
    shop.sizes.push_back(found);
  }
  if (shop.sizes.empty() || shop.sizes.size() > kMostShopSizes) {
    faults.add(table.line(), fmt::format("sizes.shop.sizes must have 1 to {} rows, such as {{ size "
                                         "= \"42\", longest_foot_mm = 268 }}",
                                         kMostShopSizes));
  }
  table.finish();
  return shop;
}

void read_sizes(SettingsTable& table, SizeRules& sizes, SettingsFaults& faults) {
  table.read("allowance_mm", sizes.allowance_mm, 0, 40);
  for (const toml::table* shop : table.tables("shop")) {
    SettingsTable one(*shop, "sizes.shop", faults);
    sizes.shop_tables.push_back(read_shop_table(one, faults));
  }
  if (sizes.shop_tables.size() > kMostShopTables) {
    faults.add(table.line(), fmt::format("there are {} [[sizes.shop]] tables, more than {}",
                                         sizes.shop_tables.size(), kMostShopTables));
  }
}

}  // namespace

void read_measuring(SettingsTable& root, MeasuringRules& measures, SizeRules& sizes,
                    SettingsFaults& faults) {
  read_section(root, "measures", faults,
               [&](SettingsTable& table) { read_measures(table, measures); });
  read_section(root, "sizes", faults,
               [&](SettingsTable& table) { read_sizes(table, sizes, faults); });
}

Result<MeasuringSettings> load_measuring_settings(const std::filesystem::path& file) {
  const auto text = read_settings_text(file, "settings file");
  if (!text) return tl::make_unexpected(text.error());
  MeasuringSettings settings;
  SettingsFaults faults(file.string());
  read_toml(*text, file, faults, [&](const toml::table& toml) {
    SettingsTable root(toml, "", faults);
    read_measuring(root, settings.measures, settings.sizes, faults);
    for (const char* other : kOfTheStation) root.pass_by(other);
    root.finish();
  });
  if (faults.count() == 0) return settings;
  return fail(ErrorCode::kInvalidInput, fmt::format("{}", fmt::join(faults.in_order(), "\n")), "");
}

}  // namespace instep
