#include "drivers/evdev/input_nodes.h"

#include <unistd.h>

#include <system_error>

#include "drivers/files/folder_entries.h"
#include "drivers/usb/sysfs.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

/// As the kernel numbers it (BUS_USB of linux/input.h), four hexadecimal digits.
constexpr const char* kUsb = "0003";

/// The name in by-id whose link leads to `node`.
std::string name_by_id(const fs::path& dev, const std::string& node) {
  for (const auto& link : entries_of(dev / "input/by-id").paths) {
    std::error_code broken;
    if (fs::read_symlink(link, broken).filename() == node) return link.filename().string();
  }
  return {};
}

bool has_keys(const fs::path& device) {
  // A mask of the keys it has, in hexadecimal words: all zeros = none.
  const std::string keys = sysfs_line(device / "capabilities/key");
  return keys.find_first_not_of("0 ") != std::string::npos;
}

}  // namespace

std::vector<InputNode> list_input_nodes(const fs::path& sysfs, const fs::path& dev) {
  std::vector<InputNode> nodes;
  for (const auto& folder : entries_of(sysfs / "class/input", "event").paths) {
    const std::string name = folder.filename().string();
    const fs::path device = folder / "device";
    if (sysfs_line(device / "id/bustype") != kUsb || !has_keys(device)) continue;
    InputNode node;
    node.path = dev / "input" / name;
    node.name = sysfs_line(device / "name");
    node.ids = sysfs_line(device / "id/vendor") + ":" + sysfs_line(device / "id/product");
    node.by_id = name_by_id(dev, name);
    node.may_read = ::access(node.path.c_str(), R_OK) == 0;
    nodes.push_back(std::move(node));
  }
  return nodes;
}

}  // namespace instep
