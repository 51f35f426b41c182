#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "config/settings.h"
#include "daemon/machine/inventory.h"

namespace instep {

/// What `instep devices` prints, for programs and for people.
nlohmann::ordered_json to_json(const Inventory& inventory, const Settings& settings);
std::string to_text(const Inventory& inventory, const Settings& settings);

}  // namespace instep
