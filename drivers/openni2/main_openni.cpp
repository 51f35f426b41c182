#include <unistd.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "drivers/openni2/child/capture_service.h"
#include "drivers/openni2/child/depth_sensor.h"
#include "drivers/openni2/child/sensor_search.h"

namespace {

constexpr int kWrongUsage = 2;

constexpr const char* kHelp =
    "Reads depth sensors through OpenNI2, for instepd.\n"
    "\n"
    "  instep-openni --list      the sensors that are plugged in, as JSON\n"
    "  instep-openni --capture   run by instepd\n";

int wrong_usage() {
  std::fputs(kHelp, stderr);
  return kWrongUsage;
}

/// Until a list may be begun: who asks for it waits for 10 s, and is to hear why there is none.
constexpr std::chrono::seconds kLongestTurn{8};

/// What was found goes to stdout, an error as an object of its own.
int list() {
  using namespace instep;
  const auto turn = load_openni().and_then([] { return SearchTurn::wait(kLongestTurn); });
  const std::string text = turn ? to_text(list_sensors()) : to_text(ChildMessage(turn.error()));
  const bool written = std::puts(text.c_str()) >= 0 && std::fflush(stdout) == 0;
  return turn && written ? 0 : 1;
}

/// The descriptors come from instepd in this order.
int capture(const instep::SensorChoice& choice) {
  using namespace instep;
  enum Inherited { kRing = 3, kConnection, kArrival };
  auto ring = FrameRing::attach(kRing);
  if (!ring) {
    std::fprintf(stderr, "instep-openni: %s\n", ring.error().line().c_str());
    return 1;
  }
  return serve_captures(choice, *ring, WakeUp(kArrival), Descriptor(kConnection));
}

/// A size as WIDTHxHEIGHT; nothing if it is written otherwise.
std::optional<instep::ImageSize> read_size(const std::string& text) {
  instep::ImageSize size;
  const char* end = text.data() + text.size();
  const auto [after_width, no_width] = std::from_chars(text.data(), end, size.width);
  if (no_width != std::errc() || after_width == end || *after_width != 'x') return {};
  const auto [after_height, no_height] = std::from_chars(after_width + 1, end, size.height);
  if (no_height != std::errc() || after_height != end) return {};
  if (size.width <= 0 || size.height <= 0) return {};
  return size;
}

std::optional<instep::SensorChoice> read_choice(const std::vector<std::string>& words) {
  instep::SensorChoice choice;
  if (words.size() % 2 == 0) return {};  // after --capture, each option has a value
  for (std::size_t i = 1; i + 1 < words.size(); i += 2) {
    const std::string& value = words[i + 1];
    if (words[i] == "--serial") {
      choice.serial = value;
    } else if (words[i] == "--size") {
      choice.size = read_size(value);
      if (!choice.size) return {};
    } else {
      return {};
    }
  }
  return choice;
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  int code = kWrongUsage;
  if (words == std::vector<std::string>{"--list"}) {
    code = list();
  } else if (words == std::vector<std::string>{"--help"}) {
    code = std::fputs(kHelp, stdout) >= 0 && std::fflush(stdout) == 0 ? 0 : 1;
  } else if (!words.empty() && words[0] == "--capture") {
    const auto choice = read_choice(words);
    code = choice ? capture(*choice) : wrong_usage();
  } else {
    code = wrong_usage();
  }
  // The library is not unloaded: that may deadlock with a sensor that is being plugged in.
  ::_exit(code);
}
