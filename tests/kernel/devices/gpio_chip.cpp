#include "tests/kernel/devices/gpio_chip.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace instep::test {
namespace {

namespace fs = std::filesystem;

void write_to(const fs::path& file, const std::string& text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY);
  const bool written = descriptor >= 0 && ::write(descriptor, text.data(), text.size()) ==
                                              static_cast<ssize_t>(text.size());
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!written) throw std::system_error(reason, std::generic_category(), file.string());
}

std::string read_from(const fs::path& file) {
  std::string text;
  std::ifstream stream(file);
  if (!std::getline(stream, text)) throw std::runtime_error(file.string() + " cannot be read");
  return text;
}

}  // namespace

GpioChip::GpioChip(std::string instance, std::string label, unsigned offset, std::string line_name)
    : folder_(fs::path("/sys/kernel/config/gpio-sim") / std::move(instance)), offset_(offset) {
  const auto bank = folder_ / "bank0";
  const auto line = bank / ("line" + std::to_string(offset));
  for (const auto& made : {folder_, bank, line}) fs::create_directory(made);
  write_to(bank / "num_lines", std::to_string(offset + 5));
  write_to(bank / "label", label);
  write_to(line / "name", line_name);
  plug_in();
}

GpioChip::~GpioChip() {
  const auto bank = folder_ / "bank0";
  std::ofstream(folder_ / "live") << "0";
  for (const auto& made : {bank / ("line" + std::to_string(offset_)), bank, folder_}) {
    ::rmdir(made.c_str());
  }
}

void GpioChip::plug_in() {
  write_to(folder_ / "live", "1");
  open_contact();
}

void GpioChip::unplug() {
  write_to(folder_ / "live", "0");
}

std::string GpioChip::node() const {
  return read_from(folder_ / "bank0" / "chip_name");
}

fs::path GpioChip::line_folder() const {
  return fs::path("/sys/devices/platform") / read_from(folder_ / "dev_name") / node() /
         ("sim_gpio" + std::to_string(offset_));
}

std::string GpioChip::bias() const {
  return read_from(line_folder() / "pull");
}

bool GpioChip::level() const {
  return read_from(line_folder() / "value") == "1";
}

void GpioChip::pull(const char* direction) const {
  write_to(line_folder() / "pull", direction);
}

}  // namespace instep::test
