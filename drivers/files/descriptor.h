#pragma once

#include <unistd.h>

#include <utility>

namespace instep {

/// An open file that is closed at the end of the scope.
class Descriptor {
 public:
  /// Owns what open(2) gave, which may be -1: not open.
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (is_open()) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }

  /// Hands it to somebody else, who has to close it.
  int release() { return std::exchange(number_, -1); }

  /// Closes now, since that may report an error of an earlier write.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

}  // namespace instep
