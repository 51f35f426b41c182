#include "daemon/command_line/clouds/girth_command.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>

#include "core/girth/girth.h"
#include "core/girth/tape_plane.h"
#include "core/noticed.h"
#include "daemon/cloud_files/text_tokens.h"
#include "daemon/command_line/clouds/cloud_options.h"
#include "daemon/command_line/command_output.h"
#include "daemon/report/result_json.h"
#include "daemon/report/text_report.h"

namespace instep {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kExamples =
    R"(The plane is given by three points, in millimetres. Examples:
  instep girth foot.ply --plane 160,-5,22,160,-5,62,170,-44,22
  instep girth foot.stl --unit m --plane 0,0,50,1,0,50,0,1,50 --method section
  instep girth points.xyz --plane 0,0,50,1,0,50,0,1,50 --sigma-mm 0.5 --format text)";

struct GirthCommand {
  CloudOptions cloud;
  std::string plane;
  std::string method = "rbf";
  std::optional<double> sigma_mm;
  std::string format;
};

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Nine finite numbers parted by commas, or nothing.
std::optional<std::array<double, 9>> nine_numbers(std::string_view text) {
  std::array<double, 9> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto end = std::min(text.find(','), text.size());
    const auto number = number_in(text.substr(0, end));
    const bool is_last = i + 1 == numbers.size();
    if (!number || !std::isfinite(*number) || (end == text.size()) != is_last) return {};
    numbers[i] = *number;
    text.remove_prefix(is_last ? end : end + 1);
  }
  return numbers;
}

std::string check_plane(const std::string& text) {
  return nine_numbers(text) ? "" : "needs nine finite numbers X1,Y1,Z1,X2,Y2,Z2,X3,Y3,Z3";
}

std::string check_sigma(const std::string& text) {
  const auto sigma = number_in(text);
  return sigma && *sigma > 0.0 && *sigma <= kLargestSigmaMm ? ""
                                                            : "needs a number above 0, at most 100";
}

Result<TapePlane> plane_of(const GirthCommand& command) {
  const auto n = nine_numbers(command.plane).value_or(std::array<double, 9>{});
  return TapePlane::through({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]});
}

/// Why the noise that was given is not used, if so.
std::optional<std::string> unused_sigma(const GirthCommand& command, const CloudFile& file) {
  if (!command.sigma_mm) return std::nullopt;
  if (command.method != "rbf" && command.method != "mesh") {
    return "--sigma-mm was not used: the method " + command.method + " knows no noise";
  }
  if (!file.cloud.has_sigma()) return std::nullopt;
  return command.cloud.file + " tells the noise of each point: --sigma-mm was not used";
}

Result<Girth> measure(const GirthCommand& command, const CloudFile& file, const TapePlane& plane) {
  const GirthOptions options{file.cloud.has_sigma() ? std::nullopt : command.sigma_mm};
  if (command.method == "hull") return girth_by_hull(file.cloud, plane, options);
  if (command.method == "mesh") return girth_by_mesh(file.cloud, plane, options);
  if (command.method == "rbf") return girth_by_rbf(file.cloud, plane, options);
  if (command.method == "rbf-paper") return girth_by_paper(file.cloud, plane, options);
  if (file.mesh.empty()) {
    return fail(ErrorCode::kInvalidInput, command.cloud.file + " has no faces to cut",
                "use --method rbf, or give a mesh");
  }
  return girth_by_section(file.mesh, plane);
}

/// A plane that is given in another unit than millimetres has its points where feet have none.
std::optional<std::string> doubt_of_plane(const TapePlane& plane) {
  constexpr double kNearestLandmarks_mm = 1.0;
  const auto& c = plane.control_points();
  const double spread_mm =
      std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
  if (spread_mm >= kNearestLandmarks_mm) return std::nullopt;
  return fmt::format(
      "the points of --plane, which are read in mm, lie within {:.2g} mm of each other", spread_mm);
}

Result<void> run(const GirthCommand& command) {
  const auto start = Clock::now();
  GirthTimes times;
  const auto plane = plane_of(command);
  if (!plane) return tl::make_unexpected(plane.error());
  const auto file = read_cloud(command.cloud);
  if (!file) return tl::make_unexpected(file.error());
  times.read_ms = milliseconds_since(start);

  const auto measuring = Clock::now();
  auto girth = measure(command, *file, *plane);
  const auto doubt = doubt_of_plane(*plane);
  if (!girth) {
    if (doubt) girth.error().advice += "; " + *doubt;
    return tl::make_unexpected(with_what_was_noticed(girth.error(), file->notes));
  }
  times.measure_ms = milliseconds_since(measuring);
  times.total_ms = milliseconds_since(start);

  if (doubt) girth->warnings.insert(girth->warnings.begin(), *doubt);
  if (const auto unused = unused_sigma(command, *file)) girth->warnings.push_back(*unused);
  girth->warnings.insert(girth->warnings.begin(), file->notes.begin(), file->notes.end());
  const bool as_text = command.format.empty() ? stdout_is_terminal() : command.format == "text";
  return as_text ? print_text(girth_text(command.method, *girth))
                 : print_json(girth_json(command.method, *girth, times));
}

}  // namespace

void add_girth_command(CLI::App& app, int& exit_code) {
  auto* girth = app.add_subcommand("girth", "The girth of a cloud or mesh in one tape plane");
  girth->footer(kExamples);
  const auto command = std::make_shared<GirthCommand>();
  add_cloud_options(*girth, command->cloud);
  girth
      ->add_option("--plane", command->plane,
                   "where the tape lies: three points, X1,Y1,Z1,X2,Y2,Z2,X3,Y3,Z3")
      ->required()
      ->check(check_plane);
  girth
      ->add_option("--method", command->method,
                   "rbf (the best), rbf-paper (as published, for comparison), hull (of the points "
                   "near the plane), mesh (grown from the points), section (of the faces)")
      ->check(CLI::IsMember({"rbf", "rbf-paper", "hull", "mesh", "section"}))
      ->capture_default_str();
  girth
      ->add_option("--sigma-mm", command->sigma_mm,
                   "noise of a point along its normal, where the file tells none of each point, in "
                   "place of what the points show; if they plainly scatter more than this, it is "
                   "not believed")
      ->check(check_sigma);
  girth->add_option("--format", command->format, "json (if stdout is no terminal) or text")
      ->check(CLI::IsMember({"json", "text"}));
  girth->callback([command, &exit_code] { exit_code = finish_command(run(*command)); });
}

}  // namespace instep
