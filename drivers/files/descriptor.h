#pragma once

#include <unistd.h>

#include <utility>

namespace instep {

/// An open file that is closed at the end of the scope, unless it was moved to another.
class Descriptor {
 public:
  Descriptor() = default;
  /// Owns what open(2) gave, which may be -1: not open.
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (is_open()) ::close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }

  /// Closes now, since that may report an error of an earlier write.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_ = -1;
};

}  // namespace instep
