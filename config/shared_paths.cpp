#include "config/shared_paths.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <map>
#include <vector>

namespace instep {

std::string warning_of_shared_paths(const Settings& settings) {
  std::map<std::filesystem::path, std::vector<std::string>> names;
  names[settings.store.root.lexically_normal()].emplace_back("store.root");
  names[settings.control.socket.lexically_normal()].emplace_back("control.socket");
  if (settings.pedal.kind == PedalKind::kSimulated) {
    names[settings.pedal.fifo.lexically_normal()].emplace_back("pedal.fifo");
  }
  for (const auto& [path, sharing] : names) {
    if (sharing.size() < 2) continue;
    return fmt::format("{} are all {}: give each a place of its own", fmt::join(sharing, ", "),
                       path.string());
  }
  return "";
}

}  // namespace instep
