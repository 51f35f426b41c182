#include "drivers/v4l2/video_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "drivers/files/folder_entries.h"
#include "drivers/usb/sysfs.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNodePrefix = "video";

/// N of videoN; nothing for other names, such as radio0.
std::optional<int> number_of(const std::string& name) {
  if (!name.starts_with(kNodePrefix)) return std::nullopt;
  int number = 0;
  const char* end = name.data() + name.size();
  const auto read = std::from_chars(name.data() + kNodePrefix.size(), end, number);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return number;
}

std::string text_of(const UsbAddress& wanted) {
  std::string text;
  if (!wanted.serial.empty()) text = "serial " + wanted.serial;
  if (!wanted.bus_path.empty())
    text += (text.empty() ? "" : " and ") + ("bus path " + wanted.bus_path);
  return text;
}

std::string list_devices(const std::vector<VideoNode>& nodes) {
  std::set<std::string> texts;
  for (const auto& node : nodes) texts.insert(node.device.text());
  if (texts.empty()) return "no camera is plugged in";
  return fmt::format("there {} {}", texts.size() == 1 ? "is only" : "are", fmt::join(texts, "; "));
}

}  // namespace

std::vector<VideoNode> list_video_nodes(const DeviceFolders& folders) {
  std::vector<std::pair<int, VideoNode>> found;
  for (const auto& folder : entries_of(folders.sysfs / "class/video4linux").paths) {
    const std::string name = folder.filename().string();
    const auto number = number_of(name);
    const auto device = number ? read_usb_device(folder / "device") : std::nullopt;
    if (!device) continue;
    found.emplace_back(*number,
                       VideoNode{folders.dev / name, sysfs_line(folder / "name"), *device});
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<VideoNode> list;
  for (auto& [number, node] : found) list.push_back(std::move(node));
  return list;
}

Result<std::vector<VideoNode>> find_video_nodes(const UsbAddress& wanted,
                                                const DeviceFolders& folders) {
  const auto all = list_video_nodes(folders);
  std::vector<VideoNode> found;
  for (const auto& node : all) {
    if (node.device.is_meant_by(wanted)) found.push_back(node);
  }
  if (found.empty()) {
    return fail(ErrorCode::kDeviceGone,
                fmt::format("no camera with {}: {}", text_of(wanted), list_devices(all)),
                "plug it in, or correct serial and bus_path in the settings");
  }
  const auto& first = found.front().device;
  for (const auto& node : found) {
    if (node.device.address == first.address) continue;
    return fail(ErrorCode::kInvalidInput,
                fmt::format("{} fits {} and {}", text_of(wanted), first.text(), node.device.text()),
                "tell them apart by bus_path");
  }
  return found;
}

}  // namespace instep
