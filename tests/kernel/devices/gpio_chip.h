#pragma once

#include <filesystem>
#include <string>

namespace instep::test {

/// A GPIO chip in software (gpio-sim), with one line that has a name, driven like a contact.
class GpioChip {
 public:
  /// `instance` tells several of them apart. The chip is plugged in, the contact open (pulled up).
  GpioChip(std::string instance, std::string label, unsigned offset, std::string line_name);
  ~GpioChip();
  GpioChip(const GpioChip&) = delete;
  GpioChip& operator=(const GpioChip&) = delete;

  void close_contact() const { pull("pull-down"); }
  void open_contact() const { pull("pull-up"); }
  void unplug();
  void plug_in();
  /// Such as "gpiochip0": another one after a while away, if somebody still held the old.
  std::string node() const;
  /// What the line's user asked for, or the contact last set: "pull-up" or "pull-down".
  std::string bias() const;
  /// Drives a line that is an output: its level as the kernel has it.
  bool level() const;

 private:
  std::filesystem::path line_folder() const;
  void pull(const char* direction) const;

  std::filesystem::path folder_;  ///< in configfs
  unsigned offset_;
};

}  // namespace instep::test
