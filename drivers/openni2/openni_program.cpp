#include "drivers/openni2/openni_program.h"

#include <fcntl.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "drivers/files/descriptor.h"

namespace instep {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

constexpr const char* kSearchPath = "LD_LIBRARY_PATH";

/// The folder, before those that are searched already.
std::string searched_first(const std::filesystem::path& folder) {
  const char* others = std::getenv(kSearchPath);
  return others == nullptr ? folder.string() : folder.string() + ":" + others;
}

/// Until its writers have closed it.
Result<std::string> read_list(const Descriptor& from, steady_clock::time_point deadline) {
  constexpr std::size_t kLongestList = 1024 * 1024;
  std::string text;
  while (true) {
    const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now());
    pollfd waited{from.number(), POLLIN, 0};
    const int ready = left.count() <= 0 ? 0 : ::poll(&waited, 1, static_cast<int>(left.count()));
    if (ready == 0) {
      return fail(ErrorCode::kTimeout, "OpenNI2 did not list its sensors in time",
                  "unplug the sensors, plug them in one by one and look which one hangs");
    }
    if (ready < 0) {  // to read all the same could wait for ever
      if (errno == EINTR) continue;
      return fail(ErrorCode::kIo, Remedy::kRetry,
                  std::string("waiting for instep-openni failed: ") + std::strerror(errno),
                  "check the limits on open files and memory");
    }
    std::array<char, 4096> block;
    const ssize_t got = ::read(from.number(), block.data(), block.size());
    if (got <= 0 || text.size() > kLongestList) return text;
    text.append(block.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

Result<ChildProgram> OpenniProgram::with(std::vector<std::string> arguments) const {
  ChildProgram program;
  program.file = file;
  program.arguments = std::move(arguments);
  if (library_folder.empty()) return program;
  std::error_code missing;
  if (!std::filesystem::exists(library_folder / "libOpenNI2.so.0", missing)) {
    return fail(
        ErrorCode::kNotFound, "there is no libOpenNI2.so.0 in " + library_folder.string(),
        "correct library_folder; if the maker calls it libOpenNI2.so, link it to that name");
  }
  program.environment.emplace_back(kSearchPath, searched_first(library_folder));
  return program;
}

Result<std::vector<OpenniDevice>> list_openni_devices(const OpenniProgram& program,
                                                      milliseconds limit) {
  const auto deadline = steady_clock::now() + limit;
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return fail(ErrorCode::kIo, Remedy::kRetry, "there is no pipe to be had",
                "close some programs");
  }
  const Descriptor from(ends[0]);
  Descriptor to(ends[1]);
  auto child = program.with({"--list"});
  if (!child) return tl::make_unexpected(child.error());
  child->output = to.number();
  auto process = ChildProcess::start(*child);
  if (!process) return tl::make_unexpected(process.error());
  to.close();

  const auto text = read_list(from, deadline);
  if (!text) return tl::make_unexpected(text.error());
  if (!text->empty()) return parse_device_list(*text);
  const auto end = process->wait(milliseconds(500));
  return fail(ErrorCode::kDeviceGone, Remedy::kRetry,
              "instep-openni " + end.value_or("closed its output"),
              "look for its reason with instep-openni --list");
}

}  // namespace instep
