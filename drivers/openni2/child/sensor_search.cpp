#include "drivers/openni2/child/sensor_search.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <climits>
#include <optional>
#include <thread>

namespace instep {
namespace {

std::string with_serials(const std::vector<std::string>& serials) {
  if (serials.empty()) return "there is no other";
  std::string text;
  for (const auto& serial : serials) {
    text += (text.empty() ? "" : ", ") + (serial.empty() ? "one without a number" : serial);
  }
  return "there is " + text;
}

tl::unexpected<Error> not_found(const std::string& serial, const std::vector<std::string>& others,
                                const std::optional<Error>& trouble) {
  const std::string wanted =
      serial.empty() ? "no OpenNI2 sensor is" : "the OpenNI2 sensor " + serial + " is not";
  if (!trouble) {
    return fail(ErrorCode::kNotFound, Remedy::kReopen,
                fmt::format("{} plugged in ({})", wanted, with_serials(others)),
                "plug it in, or correct its serial number in the settings");
  }
  return fail(ErrorCode::kNotFound, Remedy::kReopen,
              fmt::format("{} plugged in, unless it is one that cannot be opened ({}{})", wanted,
                          others.empty() ? "" : with_serials(others) + ", and ", trouble->message),
              "plug it in, or correct its serial number in the settings; if both are right, " +
                  trouble->advice);
}

/// Where OpenNI2 was loaded from: those who load the same one see the same sensors. This program's
/// own file where that cannot be told.
std::string library_folder() {
  std::array<char, PATH_MAX> folder{};
  void* library = ::dlopen("libOpenNI2.so.0", RTLD_NOLOAD | RTLD_LAZY);
  if (library == nullptr) return "/proc/self/exe";
  const bool known = ::dlinfo(library, RTLD_DI_ORIGIN, folder.data()) == 0;
  ::dlclose(library);
  return known ? folder.data() : "/proc/self/exe";
}

}  // namespace

Result<SearchTurn> SearchTurn::wait(std::chrono::milliseconds limit,
                                    const std::function<void()>& on_pause) {
  using std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kPause{10};
  const auto deadline = steady_clock::now() + limit;
  // It needs no file of its own, and the kernel unlocks it when the process ends.
  Descriptor lock(::open(library_folder().c_str(), O_RDONLY | O_CLOEXEC));
  // Where there is no locking (a network's file system), nobody waits.
  while (::flock(lock.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    if (steady_clock::now() > deadline) {
      return fail(ErrorCode::kTimeout, "another instep-openni hangs at opening a sensor",
                  "unplug the sensors and plug them in again");
    }
    on_pause();
    std::this_thread::sleep_for(kPause);
  }
  return SearchTurn(std::move(lock));
}

Result<std::unique_ptr<DepthSensor>> find_sensor(const std::string& serial) {
  const auto places = plugged_in_sensors();
  if (serial.empty() && places.size() > 1) {
    return fail(ErrorCode::kInvalidInput,
                fmt::format("there are {} OpenNI2 sensors, and it is not said which one is meant",
                            places.size()),
                "give the serial number that instep devices shows");
  }
  std::unique_ptr<DepthSensor> found;
  std::vector<std::string> others;
  std::optional<Error> first_trouble;
  for (const OpenniDevice& place : places) {
    auto sensor = DepthSensor::open(place);
    if (!sensor) {
      if (!first_trouble) first_trouble = sensor.error();
      continue;
    }
    if (!serial.empty() && (*sensor)->device().serial != serial) {
      others.push_back((*sensor)->device().serial);
    } else if (found) {
      return fail(ErrorCode::kInvalidInput, "two OpenNI2 sensors have the serial number " + serial,
                  "leave only one of them plugged in");
    } else {
      found = std::move(*sensor);
    }
  }
  if (found) return found;
  // Of one that cannot be opened it is not known whether it is the one: mostly it is another camera
  // of this very station.
  const bool says_all =
      first_trouble && (serial.empty() || first_trouble->code == ErrorCode::kPermissionDenied);
  if (says_all) return tl::make_unexpected(*first_trouble);
  return not_found(serial, others, first_trouble);
}

std::vector<OpenniDevice> list_sensors() {
  std::vector<OpenniDevice> sensors = plugged_in_sensors();
  for (OpenniDevice& sensor : sensors) {
    const auto opened = DepthSensor::open(sensor);
    if (opened) {
      sensor = (*opened)->device();
    } else {
      sensor.trouble = opened.error().line();
    }
  }
  return sensors;
}

}  // namespace instep
