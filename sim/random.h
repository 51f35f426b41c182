#pragma once

#include <array>
#include <cstdint>
#include <random>

namespace instep {

/// A seed for a part of a simulation, so that parts draw independently of each other and of the
/// order in which they are made. (The finaliser of SplitMix64.)
inline std::uint64_t seed_for(std::uint64_t seed, std::uint64_t part) {
  std::uint64_t mixed = seed + 0x9E3779B97F4A7C15ULL * (part + 1);
  mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBULL;
  return mixed ^ (mixed >> 31U);
}

/// Random numbers with distributions that give the same bytes with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }

  /// From [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }

  double uniform(double lowest, double highest) { return lowest + (highest - lowest) * uniform(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace instep
