#include "daemon/command_line/recordings/station_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

#include "daemon/command_line/command_output.h"
#include "daemon/control/control_client.h"
#include "daemon/station/devices.h"

namespace instep {
namespace {

/// The light that a scan has; null if there is none, or none to be had.
std::unique_ptr<OutputLine> light_of(const OutputSettings& outputs) {
  if (!outputs.projector) return nullptr;
  auto projector = open_output(*outputs.projector);
  const auto lit = projector.and_then([](const auto& line) { return line->set(true); });
  if (lit) return std::move(*projector);
  fmt::print(stderr, "instep: recorded without the projector: {}\n", lit.error().line());
  return nullptr;
}

/// What opening them would fail with says of each camera that somebody has it, and never who.
Result<void> check_that_no_daemon_has(const Settings& settings) {
  const bool has_real_cameras =
      std::any_of(settings.cameras.begin(), settings.cameras.end(),
                  [](const auto& camera) { return camera.placement() != nullptr; });
  if (!has_real_cameras) return {};
  const auto client = ControlClient::connect(settings.control.socket);
  if (!client && client.error().code == ErrorCode::kNotFound) return {};
  if (!client) {
    Error unknown = client.error();
    unknown.message = "it cannot be told whether a daemon has the cameras: " + unknown.message;
    return tl::make_unexpected(unknown);
  }
  return fail(ErrorCode::kBusy, Remedy::kOperator,
              "the daemon has the cameras: it answers on " + settings.control.socket.string(),
              "systemctl stop instepd, and start it again afterwards");
}

}  // namespace

Result<Recording> record_station(const Settings& settings, const RecordingLength& length,
                                 const std::filesystem::path& folder, const StopRequest& stop) {
  if (auto free = check_that_no_daemon_has(settings); !free) {
    return tl::make_unexpected(free.error());
  }
  const auto devices = open_devices(settings);
  if (!devices) return tl::make_unexpected(devices.error());
  Recording header;
  header.platform_height_mm = platform_height_mm(settings, *devices);
  header.simulated = devices->simulated;
  if (devices->work_out_truth) {
    auto truth = devices->work_out_truth();
    if (!truth) return tl::make_unexpected(truth.error());
    header.truth = std::move(*truth);
  }
  if (stop.is_made()) return tl::make_unexpected(recording_stopped());
  const auto light = light_of(settings.outputs);
  ProgressLine line;
  RecordingPlan plan;
  plan.length = length;
  plan.warmup_frames = settings.capture.warmup_frames;
  if (settings.capture.one_at_a_time) plan.turns = CameraTurns::kOneAtATime;
  return capture_recording(devices->cameras, header, plan, folder, [&](double done) {
    line.show("recording", done);
    return !stop.is_made();
  });
}

}  // namespace instep
