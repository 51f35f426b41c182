#include "daemon/command_line/recordings/simulate_command.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>

#include "daemon/command_line/command_output.h"
#include "daemon/command_line/recordings/capture_recording.h"
#include "daemon/command_line/stop_request.h"
#include "daemon/station/devices.h"
#include "drivers/recording/recording_writer.h"
#include "sim/simulated_station.h"

namespace instep {
namespace {

constexpr const char* kExamples = R"(The same seed gives the same bytes. Examples:
  instep simulate --out visit --seed 7
  instep simulate --out cylinder --subject cylinder --noise none --frames 1)";

struct SimulateCommand {
  std::string folder;
  std::uint64_t seed = 1;
  std::string subject = "foot";
  std::string side;
  std::string noise = "typical";
  int cameras = 4;
  std::size_t frames = 15;
};

/// The parser alone would take -1, and what is too large, for the largest number there is.
std::string check_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const auto end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, seed);
  return stop == end && error == std::errc{}
             ? ""
             : "needs a whole number from 0 to 18446744073709551615";
}

/// What takes no time, so that nothing is computed in vain.
Result<void> check(const SimulateCommand& command) {
  if (!command.side.empty() && command.subject != "foot") {
    return fail(ErrorCode::kInvalidInput,
                "--side says which foot it is, and --subject " + command.subject + " has no choice",
                "leave --side out, or use --subject foot");
  }
  return RecordingWriter::check_folder(command.folder);
}

Result<SimulatedStation> build(const SimulateCommand& command) {
  SimulationSettings settings;
  settings.seed = command.seed;
  settings.subject = subject_from_string(command.subject).value_or(settings.subject);
  settings.side = side_from_string(command.side).value_or(settings.side);
  settings.noise = noise_law_from_string(command.noise).value_or(settings.noise);
  settings.cameras = command.cameras;
  settings.pacing = Pacing::kAsFastAsPossible;
  return build_station(settings);
}

Result<void> run(const SimulateCommand& command) {
  if (auto good = check(command); !good) return tl::make_unexpected(good.error());
  const auto station = build(command);
  if (!station) return tl::make_unexpected(station.error());
  const auto truth = station->truth();
  if (!truth) return tl::make_unexpected(truth.error());
  Recording header;
  header.platform_height_mm = station->platform_height_mm;
  header.truth = truth_by_id(*truth);
  header.simulated = true;
  const StopRequest stop;
  ProgressLine line;
  RecordingPlan plan;
  plan.length.frames_per_camera = command.frames;
  plan.clocks = CameraClocks::kOneForAll;
  const auto recording =
      capture_recording(station->cameras, header, plan, command.folder, [&](double done) {
        line.show("simulating", done);
        return !stop.is_made();
      });
  if (!recording) return tl::make_unexpected(recording.error());
  return print_json({{"folder", command.folder},
                     {"seed", command.seed},
                     {"simulated", true},
                     {"cameras", recording->cameras.size()},
                     {"frames", recording->frames.size()},
                     {"truth", recording->truth}});
}

}  // namespace

void add_simulate_command(CLI::App& app, int& exit_code) {
  auto* simulate =
      app.add_subcommand("simulate", "Make up a recording of feet whose true measures are known");
  simulate->footer(kExamples);
  const auto command = std::make_shared<SimulateCommand>();
  simulate->add_option("--out", command->folder, "folder to make")->required();
  simulate->add_option("--seed", command->seed, "number that decides shape, stance and noise")
      ->check(check_seed)
      ->capture_default_str();
  simulate->add_option("--subject", command->subject, "what stands on the platform")
      ->check(CLI::IsMember({"foot", "feet", "cylinder", "last"}))
      ->capture_default_str();
  simulate->add_option("--side", command->side, "which foot, of --subject foot: right if not given")
      ->check(CLI::IsMember({"left", "right"}));
  simulate->add_option("--noise", command->noise, "how much the cameras err")
      ->check(CLI::IsMember({"none", "typical", "pessimistic"}))
      ->capture_default_str();
  simulate->add_option("--cameras", command->cameras, "how many stand round the platform")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  simulate
      ->add_option("--frames", command->frames,
                   "how many each camera takes (a scan 15 if nothing is said, 120 at the most)")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  simulate->callback([command, &exit_code] { exit_code = finish_command(run(*command)); });
}

}  // namespace instep
