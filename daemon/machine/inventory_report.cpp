#include "daemon/machine/inventory_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace instep {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

Json camera_json(const PluggedCamera& camera) {
  Json nodes = Json::array();
  for (const auto& node : camera.nodes) nodes.push_back(node.string());
  Json modes = Json::array();
  for (const auto& mode : camera.modes) {
    modes.push_back({{"format", mode.format}, {"sizes_px", mode.sizes}});
  }
  const auto& device = camera.device;
  return {{"kind", camera.kind},
          {"product", device.product},
          {"serial", or_null(device.address.serial)},
          {"bus_path", or_null(device.address.bus_path)},
          {"nodes", std::move(nodes)},
          {"link_mbps", device.link_mbps},
          {"could_be_faster", device.could_be_faster},
          {"modes", std::move(modes)},
          {"configured_as", or_null(camera.configured_as)},
          {"trouble", or_null(camera.trouble)}};
}

Json chip_json(const GpioChipState& chip, const Settings& settings) {
  Json lines = Json::array();
  for (const auto& line : chip.lines) {
    const auto use = use_of_line(settings, chip, line);
    lines.push_back({{"offset", line.offset},
                     {"name", or_null(line.name)},
                     {"held_by", or_null(line.holder)},
                     {"is_pedal", use == "pedal"},
                     {"configured_as", or_null(use)}});
  }
  return {{"node", chip.node.string()},       {"label", chip.label},
          {"line_count", chip.line_count},    {"may_open", chip.may_open},
          {"trouble", or_null(chip.trouble)}, {"lines", std::move(lines)}};
}

Json switch_json(const InputNode& node, const PedalSettings& pedal) {
  return {{"node", node.path.string()},
          {"name", node.name},
          {"ids", node.ids},
          {"by_id", or_null(node.by_id)},
          {"may_open", node.may_read},
          {"is_pedal", is_pedal(pedal, node)}};
}

std::string link_text(const UsbDevice& device) {
  if (device.address.bus_path.empty()) return "not on USB";
  if (device.link_mbps == 0) return "unknown link";
  return fmt::format("{} Mbit/s{}", device.link_mbps,
                     device.could_be_faster ? " (it could be faster: use a USB 3 socket)" : "");
}

std::string camera_text(const PluggedCamera& camera) {
  std::string text = fmt::format(
      "  {}\n    kind \"{}\", {}{}\n", camera.device.text(), camera.kind, link_text(camera.device),
      camera.configured_as.empty() ? "" : ", configured as " + camera.configured_as);
  for (const auto& node : camera.nodes) text += "    " + node.string() + "\n";
  if (!camera.trouble.empty()) text += "    cannot be used now: " + camera.trouble + "\n";
  for (const auto& mode : camera.modes) {
    text += fmt::format("    {:<4} {}\n", mode.format, fmt::join(mode.sizes, " "));
  }
  return text;
}

std::string chip_text(const GpioChipState& chip, const Settings& settings) {
  const std::string node = chip.node.string();
  if (!chip.may_open) return fmt::format("  {}: you may not open it\n", node);
  if (!chip.trouble.empty()) return fmt::format("  {} cannot be opened: {}\n", node, chip.trouble);
  std::string text = fmt::format("  \"{}\", {} lines, now {}\n", chip.label, chip.line_count, node);
  for (const auto& line : chip.lines) {
    const auto use = use_of_line(settings, chip, line);
    text += fmt::format("    {:>4} {}{}{}\n", line.offset,
                        line.name.empty() ? "without name" : '"' + line.name + '"',
                        line.holder.empty() ? "" : ", held by " + line.holder,
                        use.empty() ? "" : ", the " + use);
  }
  return text;
}

std::string switch_text(const InputNode& node, const PedalSettings& pedal) {
  return fmt::format("  {} \"{}\"{}, now {}{}{}\n", node.ids, node.name,
                     node.by_id.empty() ? "" : ", " + node.by_id, node.path.string(),
                     node.may_read ? "" : ", which you may not open",
                     is_pedal(pedal, node) ? ", the pedal" : "");
}

/// A heading with its lines, or with "none".
std::string section(const char* heading, const std::string& lines) {
  return std::string(heading) + "\n" + (lines.empty() ? "  none\n" : lines);
}

}  // namespace

Json to_json(const Inventory& inventory, const Settings& settings) {
  Json cameras = Json::array();
  for (const auto& camera : inventory.cameras) cameras.push_back(camera_json(camera));
  Json chips = Json::array();
  for (const auto& chip : inventory.gpio_chips) chips.push_back(chip_json(chip, settings));
  Json switches = Json::array();
  for (const auto& node : inventory.foot_switches) {
    switches.push_back(switch_json(node, settings.pedal));
  }
  Json troubles = Json::array();
  for (const auto& trouble : inventory.openni_troubles) troubles.push_back(trouble.line());
  return {{"cameras", std::move(cameras)},
          {"openni_troubles", std::move(troubles)},
          {"gpio_chips", std::move(chips)},
          {"input_devices", std::move(switches)}};
}

std::string to_text(const Inventory& inventory, const Settings& settings) {
  std::string cameras;
  for (const auto& camera : inventory.cameras) cameras += camera_text(camera);
  for (const auto& trouble : inventory.openni_troubles) {
    cameras += "  OpenNI2 lists no sensors: " + trouble.line() + "\n";
  }
  std::string chips;
  for (const auto& chip : inventory.gpio_chips) chips += chip_text(chip, settings);
  std::string switches;
  for (const auto& node : inventory.foot_switches) switches += switch_text(node, settings.pedal);
  return section("Cameras", cameras) + section("GPIO chips", chips) +
         section("Input devices with keys", switches);
}

}  // namespace instep
