#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// The logarithm of what is known round some places (`log_of` each, which has a `place`), at
/// another place: the mean of all, weighed by the fourth power of their nearness, so that the
/// nearest count. At least one is known.
template <class Local, class LogOf>
double local_log_mean(const std::vector<Local>& known, const Eigen::Vector3d& place,
                      const LogOf& log_of) {
  constexpr double kNoDistance = 1e-30;
  double weights = 0.0;
  double sum = 0.0;
  for (const auto& local : known) {
    const double squared = (local.place - place).squaredNorm();
    const double weight = 1.0 / (squared * squared + kNoDistance);
    weights += weight;
    sum += weight * log_of(local);
  }
  return sum / weights;
}

}  // namespace instep
