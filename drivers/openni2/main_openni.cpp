#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
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

/// What was found goes to stdout, an error as an object of its own.
int list() {
  using namespace instep;
  const auto turn = load_openni().and_then([] { return SearchTurn::wait(); });
  const std::string text = turn ? to_text(list_sensors()) : to_text(ChildMessage(turn.error()));
  const bool written = std::puts(text.c_str()) >= 0 && std::fflush(stdout) == 0;
  return turn && written ? 0 : 1;
}

/// The descriptors come from instepd in this order.
int capture(const instep::SensorChoice& choice) {
  using namespace instep;
  enum Inherited { kRing = 3, kConnection, kArrival };
  auto ring = FrameRing::attach(kRing);
  if (!ring) return wrong_usage();
  return serve_captures(choice, *ring, WakeUp(kArrival), Descriptor(kConnection));
}

std::optional<instep::SensorChoice> read_choice(const std::vector<std::string>& words) {
  instep::SensorChoice choice;
  for (std::size_t i = 1; i + 1 < words.size(); i += 2) {
    const std::string& value = words[i + 1];
    if (words[i] == "--serial") {
      choice.serial = value;
    } else if (words[i] == "--size") {
      instep::ImageSize size;
      if (std::sscanf(value.c_str(), "%5dx%5d", &size.width, &size.height) != 2) return {};
      choice.size = size;
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
