#include "tests/support/openni_bus.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "tests/support/places.h"

namespace instep::test {
namespace {

std::filesystem::path bus_file(const std::filesystem::path& root, const std::string& serial) {
  return root / "bus" / (serial + ".device");
}

struct ProcessState {
  std::string program;
  char letter = ' ';
  pid_t parent = 0;
};

std::optional<ProcessState> state_of(const std::string& process) {
  std::ifstream stream("/proc/" + process + "/stat");
  std::string text;
  std::getline(stream, text);
  // After the name, in parentheses and with anything in it, come the state and the parent.
  const auto begin = text.find('(');
  const auto end = text.rfind(')');
  if (begin == std::string::npos || end == std::string::npos) return std::nullopt;
  ProcessState state;
  state.program = text.substr(begin + 1, end - begin - 1);
  std::istringstream rest(text.substr(end + 1));
  rest >> state.letter >> state.parent;
  return state;
}

void write_images(const std::filesystem::path& file, const BusSensor& sensor) {
  const auto images =
      sensor.images.empty() ? test_images(sensor.width, sensor.height) : sensor.images;
  std::ofstream stream(file, std::ios::binary);
  for (const auto& image : images) {
    stream.write(reinterpret_cast<const char*>(image.data()),
                 static_cast<std::streamsize>(image.size() * sizeof image[0]));
  }
}

}  // namespace

OpenniBus::OpenniBus() {
  std::filesystem::create_directories(folder() / "OpenNI2/Drivers");
  std::filesystem::create_directory(folder() / "bus");
  std::filesystem::create_symlink(INSTEP_OPENNI2_LIBRARY, folder() / "libOpenNI2.so.0");
  std::filesystem::create_symlink(INSTEP_OPENNI2_MODULE,
                                  folder() / "OpenNI2/Drivers/libinstepsim.so.0");
}

void OpenniBus::plug_in(const BusSensor& sensor) {
  ++plugged_in_;
  const auto known = std::find_if(sensors_.begin(), sensors_.end(), [&](const BusSensor& other) {
    return other.serial == sensor.serial;
  });
  const auto index = static_cast<std::size_t>(known - sensors_.begin());
  if (known == sensors_.end()) {
    sensors_.emplace_back();
    uris_.emplace_back();
  }
  sensors_[index] = sensor;
  uris_[index] = last_uri();
  // A new file each time: the old one is mapped by those who had the sensor open.
  const auto images = folder() / (sensor.serial + ".raw");
  std::filesystem::remove(images);
  write_images(images, sensor);
  write(sensor, last_uri());
}

void OpenniBus::unplug(const std::string& serial) const {
  std::filesystem::remove(bus_file(folder(), serial));
}

void OpenniBus::set_faults(const std::string& serial, const std::set<std::string>& faults) {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (sensors_[i].serial != serial) continue;
    sensors_[i].faults = faults;
    write(sensors_[i], uris_[i]);
  }
}

void OpenniBus::write(const BusSensor& sensor, const std::string& uri) const {
  std::ostringstream text;
  text.precision(17);
  text << "serial " << sensor.serial << "\nuri " << uri << "\nframes "
       << (folder() / (sensor.serial + ".raw")).string() << "\nwidth " << sensor.width
       << "\nheight " << sensor.height << "\nunit_um " << sensor.unit_um << "\nhfov_rad "
       << sensor.hfov_rad << "\nvfov_rad " << sensor.vfov_rad << '\n';
  for (const auto& fault : sensor.faults) text << "fault " << fault << '\n';
  // Put in place whole: nobody sees half of it.
  const auto file = bus_file(folder(), sensor.serial);
  const auto draft = folder() / "draft";
  std::ofstream(draft) << text.str();
  std::filesystem::rename(draft, file);
}

OpenniProgram OpenniBus::program() const {
  return {built_programs() / "instep-openni", folder()};
}

OpenniCamera::Settings OpenniBus::settings(const std::string& serial) const {
  OpenniCamera::Settings settings;
  settings.name = "camera " + serial;
  settings.serial = serial;
  settings.program = program();
  return settings;
}

std::unique_ptr<OpenniCamera> OpenniBus::camera(const std::string& serial) const {
  auto camera = OpenniCamera::open(settings(serial));
  if (!camera) throw std::runtime_error(camera.error().line());
  return std::move(*camera);
}

std::vector<std::vector<std::uint16_t>> test_images(int width, int height) {
  constexpr unsigned kNearest = 1000;
  constexpr unsigned kDepths = 64000;
  constexpr unsigned kHoleEvery = 7;
  const auto pixels = static_cast<unsigned>(width * height);
  std::vector<std::vector<std::uint16_t>> images(2, std::vector<std::uint16_t>(pixels));
  for (unsigned image = 0; image < images.size(); ++image) {
    for (unsigned i = 0; i < pixels; ++i) {
      const unsigned value = kNearest + (i * 13 + image * 31337) % kDepths;
      images[image][i] = static_cast<std::uint16_t>(i % kHoleEvery == image ? 0 : value);
    }
  }
  return images;
}

std::vector<pid_t> child_processes(pid_t parent) {
  std::vector<pid_t> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const auto state = state_of(name);
    if (state && state->parent == parent) children.push_back(std::stoi(name));
  }
  return children;
}

bool runs(pid_t process, const std::string& program) {
  const auto state = state_of(std::to_string(process));
  return state && state->program == program && state->letter != 'Z';
}

}  // namespace instep::test
