#include "drivers/openni2/child_messages.h"

#include <nlohmann/json.hpp>

#include "core/error_names.h"

namespace instep {
namespace {

using nlohmann::json;

/// A device may call itself anything, UTF-8 or not.
std::string dump(const json& object) {
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

json to_json(const DepthMode& mode) {
  return {{"width", mode.width},
          {"height", mode.height},
          {"frames_per_second", mode.frames_per_second},
          {"depth_unit_mm", mode.depth_unit_mm}};
}

DepthMode mode_from(const json& object) {
  return {object.at("width").get<int>(), object.at("height").get<int>(),
          object.at("frames_per_second").get<int>(), object.at("depth_unit_mm").get<double>()};
}

json to_json(const OpenniDevice& device) {
  json modes = json::array();
  for (const DepthMode& mode : device.modes) modes.push_back(to_json(mode));
  return {{"serial", device.serial},         {"uri", device.uri},
          {"vendor", device.vendor},         {"product", device.product},
          {"usb_vendor", device.usb_vendor}, {"usb_product", device.usb_product},
          {"modes", std::move(modes)},       {"trouble", device.trouble}};
}

OpenniDevice device_from(const json& object) {
  OpenniDevice device;
  object.at("serial").get_to(device.serial);
  object.at("uri").get_to(device.uri);
  object.at("vendor").get_to(device.vendor);
  object.at("product").get_to(device.product);
  object.at("usb_vendor").get_to(device.usb_vendor);
  object.at("usb_product").get_to(device.usb_product);
  object.at("trouble").get_to(device.trouble);
  for (const json& mode : object.at("modes")) device.modes.push_back(mode_from(mode));
  return device;
}

json to_json(const Error& error) {
  return {{"event", "error"},
          {"code", to_string(error.code)},
          {"remedy", to_string(error.remedy)},
          {"message", error.message},
          {"advice", error.advice}};
}

Error error_from(const json& object) {
  return {error_code_from(object.at("code").get<std::string>()).value_or(ErrorCode::kInternal),
          remedy_from(object.at("remedy").get<std::string>()).value_or(Remedy::kBug),
          object.at("message").get<std::string>(), object.at("advice").get<std::string>()};
}

json to_json(const CameraOpened& opened) {
  return {{"event", "opened"},
          {"device", to_json(opened.device)},
          {"mode", to_json(opened.mode)},
          {"horizontal_fov_rad", opened.horizontal_fov_rad},
          {"vertical_fov_rad", opened.vertical_fov_rad}};
}
json to_json(const CameraStarted&) {
  return {{"event", "started"}};
}
json to_json(const CameraStopped&) {
  return {{"event", "stopped"}};
}

CameraOpened opened_from(const json& object) {
  return {device_from(object.at("device")), mode_from(object.at("mode")),
          object.at("horizontal_fov_rad").get<double>(),
          object.at("vertical_fov_rad").get<double>()};
}

tl::unexpected<Error> not_understood() {
  return fail(ErrorCode::kCorruptData, Remedy::kReopen,
              "instep-openni says what nobody understands",
              "install the programs of one version together");
}

Result<ChildMessage> message_from(const json& object) {
  const auto event = object.at("event").get<std::string>();
  if (event == "opened") return opened_from(object);
  if (event == "started") return CameraStarted{};
  if (event == "stopped") return CameraStopped{};
  if (event == "error") return ChildMessage(error_from(object));
  return not_understood();
}

}  // namespace

std::string to_text(const ChildMessage& message) {
  return std::visit([](const auto& one) { return dump(to_json(one)); }, message);
}

Result<ChildMessage> parse_child_message(std::string_view text) {
  try {
    return message_from(json::parse(text));
  } catch (const json::exception&) {
    return not_understood();
  }
}

std::string to_text(const std::vector<OpenniDevice>& devices) {
  json list = json::array();
  for (const OpenniDevice& device : devices) list.push_back(to_json(device));
  return dump({{"devices", std::move(list)}});
}

Result<std::vector<OpenniDevice>> parse_device_list(std::string_view text) {
  try {
    const json object = json::parse(text);
    if (object.value("event", "") == "error") return tl::make_unexpected(error_from(object));
    std::vector<OpenniDevice> devices;
    for (const json& device : object.at("devices")) devices.push_back(device_from(device));
    return devices;
  } catch (const json::exception&) {
    return not_understood();
  }
}

}  // namespace instep
