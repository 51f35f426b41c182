#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace instep {

/// An input device with keys, which may be a foot switch, as the kernel describes it.
struct InputNode {
  std::filesystem::path path;  ///< such as /dev/input/event5: this number changes
  std::string name;
  std::string ids;       ///< "0c45:7403", as EvdevPedal::Settings takes it
  std::string by_id;     ///< its name in /dev/input/by-id; empty if it has none
  bool may_read = true;  ///< whether this user may open it
};

/// The input devices on USB that have keys, by path. `sysfs` and `dev` are /sys and /dev.
std::vector<InputNode> list_input_nodes(const std::filesystem::path& sysfs,
                                        const std::filesystem::path& dev);

}  // namespace instep
