#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/support/random_numbers.h"

namespace instep::test {

/// A ring of points as a tape plane sees it, a part of which may be far denser.
class PiledRing {
 public:
  static constexpr double kRadius = 10.0;
  static constexpr double kHeight = 6.0;
  /// Where its middle lies.
  static Eigen::Vector2d middle() { return {3.0, -2.0}; }

  /// As many points on each square unit all round.
  explicit PiledRing(double density, std::uint64_t seed = 1);

  /// More of them to both sides of a direction, with noise.
  void add(double density, double half_angle, double sigma);

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  std::vector<Eigen::Vector3d>& points() { return points_; }

  /// By how much a place lies beside the direction, in radians, and off the ring.
  static double beside(const Eigen::Vector3d& place);
  static double off(const Eigen::Vector3d& place);

 private:
  RandomNumbers random_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace instep::test
